#include "sensors/laser/rplidar_session.h"

#include <gtest/gtest.h>

#include "sensors/laser/emulation/emulated_scanner.h"
#include "unit/sensors/laser/node_stream.h"

namespace stereo_nav::laser {
namespace {

using rplidar::Command;

/// A session with a scanner, or nobody, at the other end; time passes in steps of 10 ms.
class RplidarSessionTest : public testing::Test {
 protected:
  void run(double duration_s) {
    for (const double end_s = now_s_ + duration_s; now_s_ < end_s; now_s_ += 0.01) {
      Bytes bytes;
      if (answers_) {
        for (const auto& reply : scanner_.receive(to_scanner_, now_s_)) append(bytes, reply.bytes);
        for (const auto& node : scanner_.advance(now_s_)) append(bytes, node.bytes);
      }
      to_scanner_.clear();
      const std::size_t used = session_.update(bytes.data(), bytes.size(), now_s_);
      scan_.insert(scan_.end(), bytes.begin() + static_cast<std::ptrdiff_t>(used), bytes.end());
    }
  }

  ScannerOptions options_;
  EmulatedScanner scanner_{options_};
  bool answers_ = true;
  double now_s_ = 0.0;
  Bytes to_scanner_, scan_;
  std::vector<Command> commands_;
  RplidarSession session_{[this](Command command) {
    commands_.push_back(command);
    const auto bytes = rplidar::request(command);
    to_scanner_.insert(to_scanner_.end(), bytes.begin(), bytes.end());
  }};
};

TEST_F(RplidarSessionTest, StopsAsksAndStarts) {
  session_.begin(now_s_);
  run(0.5);
  EXPECT_TRUE(session_.scanning());
  EXPECT_EQ(commands_,
            (std::vector<Command>{Command::kStop, Command::kGetInfo, Command::kGetHealth, Command::kScan}));
  ASSERT_TRUE(session_.info().has_value());
  EXPECT_EQ(session_.info()->firmware_minor, 29);
  EXPECT_TRUE(session_.problem().empty());
  NodeFramer framer;
  EXPECT_GT(framed(framer, scan_).size(), 500U);
  EXPECT_EQ(framer.counters().bytes_skipped, 0U) << "nothing but nodes is passed on";
}

TEST_F(RplidarSessionTest, AScannerThatIsScanningAlreadyIsStoppedFirst) {
  scanner_.receive({0xA5, 0x20}, now_s_);
  session_.begin(now_s_);
  run(0.5);
  EXPECT_TRUE(session_.scanning());
}

TEST_F(RplidarSessionTest, AnErrorIsSaidAndResetAway) {
  options_.error_code = 0x1234;
  scanner_ = EmulatedScanner(options_);
  session_.begin(now_s_);
  run(0.5);
  EXPECT_FALSE(session_.scanning());
  EXPECT_NE(session_.problem().find("error code 4660"), std::string::npos) << session_.problem();
  run(3.0);
  EXPECT_TRUE(session_.scanning());
  EXPECT_TRUE(session_.problem().empty());
}

TEST_F(RplidarSessionTest, SilenceIsSaidAndAskedAgain) {
  answers_ = false;
  session_.begin(now_s_);
  run(2.0);
  EXPECT_FALSE(session_.scanning());
  EXPECT_NE(session_.problem().find("does not answer"), std::string::npos);
  answers_ = true;
  run(1.5);
  EXPECT_TRUE(session_.scanning());
  EXPECT_TRUE(session_.problem().empty());
}

TEST_F(RplidarSessionTest, ForeignBytesBeforeAReplyAreLeftOut) {
  session_.begin(now_s_);
  const Bytes foreign = {'R', 'P', 0xA5, 0x5A, 0xA5, 0x5A, 0x14, 0x00, 0xA5};
  session_.update(foreign.data(), foreign.size(), now_s_ + 0.01);
  now_s_ += 0.06;
  session_.update(nullptr, 0, now_s_);
  session_.update(foreign.data(), foreign.size(), now_s_);
  run(0.5);
  EXPECT_TRUE(session_.scanning());
}

}  // namespace
}  // namespace stereo_nav::laser
