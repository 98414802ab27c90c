#include <gtest/gtest.h>

#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/laser/node_stream.h"

namespace stereo_nav::laser {
namespace {

/// Compares what comes out of a framer with the last nodes that were sent.
class NodeJudge {
 public:
  /// `last`: number of the node that was sent last.
  void judge(const FramedNode& node, std::uint64_t last) {
    restarts_ += static_cast<std::uint64_t>(node.restarted);
    for (std::uint64_t back = 0; back < 8 && back <= last; ++back) {
      if (!same(node.node, nodeOf(last - back))) continue;
      ++right_;
      const auto shift = static_cast<std::int64_t>(node.index) - static_cast<std::int64_t>(last - back);
      if (shift != shift_) ++miscounts_;
      shift_ = shift;
      return;
    }
    ++wrong_;
  }

  std::uint64_t right_ = 0, wrong_ = 0, restarts_ = 0, miscounts_ = 0;

 private:
  std::int64_t shift_ = 1;  ///< of a framer's numbers, which begin at 1
};

TEST(DamagedNodeStream, AMillionNodesAreFoundAndCounted) {
  constexpr std::uint64_t kMillion = 1000000;
  serial::LineFaults faults(0.002, 0.001, 7);
  NodeFramer framer;
  NodeJudge judge;
  std::uint64_t intact = 0;
  for (std::uint64_t k = 0; k < kMillion; ++k) {
    const Bytes sent = bytesOf(k);
    Bytes received;
    intact += static_cast<std::uint64_t>(faults.pass(sent.data(), sent.size(), received));
    for (const FramedNode& node : framed(framer, received)) judge.judge(node, k);
  }
  const double damaged = static_cast<double>(kMillion - intact);
  const double found = static_cast<double>(judge.right_) / static_cast<double>(intact);
  std::cout << "intact nodes delivered: " << 100.0 * found
            << " %, damaged ones that pass: " << 100.0 * static_cast<double>(judge.wrong_) / damaged
            << " %, miscounts: " << judge.miscounts_ << "\n";
  EXPECT_GT(found, 0.997);
  EXPECT_LT(static_cast<double>(judge.wrong_), 0.7 * damaged) << "of distances nothing can be recognised";
  EXPECT_EQ(judge.restarts_, 1U);
  EXPECT_LT(judge.miscounts_, 20U);
}

}  // namespace
}  // namespace stereo_nav::laser
