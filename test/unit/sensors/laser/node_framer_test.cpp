#include "sensors/laser/node_framer.h"

#include <gtest/gtest.h>

#include <random>

#include "unit/sensors/laser/node_stream.h"

namespace stereo_nav::laser {
namespace {

constexpr std::uint64_t kBefore = 400, kNodes = 440;

/// Frames `kBefore` nodes, whatever `between` holds, and the nodes from `next` on, and expects of the latter
/// all but at most `spared`, with their right number.
void expectRecovery(const Bytes& between, std::uint64_t next, std::uint64_t spared, const std::string& what) {
  NodeFramer framer;
  std::vector<FramedNode> nodes = framed(framer, bytesOf(0, kBefore));
  ASSERT_EQ(nodes.size(), kBefore);
  const std::uint64_t offset = nodes.back().index - (kBefore - 1);
  append(nodes, framed(framer, between));
  append(nodes, framed(framer, bytesOf(next, kNodes)));
  std::vector<bool> seen(kNodes, false);
  for (const FramedNode& node : nodes) {
    const std::uint64_t k = node.index - offset;
    if (k < next) continue;
    ASSERT_LT(k, kNodes) << what;
    EXPECT_TRUE(same(node.node, nodeOf(k))) << what << ": node " << k;
    EXPECT_FALSE(node.restarted && k > 0) << what;
    seen[k] = true;
  }
  for (std::uint64_t k = next + spared; k < kNodes; ++k) {
    EXPECT_TRUE(seen[k]) << what << ": node " << k << " of those behind is missing";
  }
}

TEST(NodeFramer, DeliversEveryNodeOfACleanStream) {
  NodeFramer framer;
  const auto nodes = framed(framer, bytesOf(0, 2000));
  ASSERT_EQ(nodes.size(), 2000U);
  for (std::uint64_t k = 0; k < 2000; ++k) {
    ASSERT_TRUE(same(nodes[k].node, nodeOf(k))) << k;
    EXPECT_EQ(nodes[k].index, nodes[0].index + k);
    EXPECT_EQ(nodes[k].last_byte, 5 * k + 4);
    EXPECT_NEAR(nodes[k].turned_deg, 0.99 * static_cast<double>(k), 0.02);
  }
  EXPECT_EQ(framer.counters().bytes_skipped, 0U);
  EXPECT_EQ(framer.counters().dropped, 0U);
}

TEST(NodeFramer, DamageToAnyByteTouchesItsOwnNodeOnly) {
  for (std::size_t byte = 0; byte < rplidar::kNodeBytes; ++byte) {
    for (unsigned difference = 1; difference < 256; ++difference) {
      Bytes damaged = bytesOf(kBefore);
      damaged[byte] = static_cast<std::uint8_t>(damaged[byte] ^ difference);
      expectRecovery(damaged, kBefore + 1, 0,
                     "byte " + std::to_string(byte) + " changed by " + std::to_string(difference));
    }
  }
}

TEST(NodeFramer, LostBytesCostTheirNodeAndAtMostTheNext) {
  for (std::size_t first = 0; first < rplidar::kNodeBytes; ++first) {
    for (std::size_t count = 1; first + count <= rplidar::kNodeBytes && count < rplidar::kNodeBytes;
         ++count) {
      Bytes shortened = bytesOf(kBefore);
      shortened.erase(shortened.begin() + static_cast<std::ptrdiff_t>(first),
                      shortened.begin() + static_cast<std::ptrdiff_t>(first + count));
      // Without bytes of its distance it takes those of the next node, which is lost as well.
      expectRecovery(shortened, kBefore + 1, 1,
                     std::to_string(count) + " lost from " + std::to_string(first));
    }
  }
}

TEST(NodeFramer, WholeNodesThatAreLostAreCountedByTheirHeadings) {
  NodeFramer framer;
  framed(framer, bytesOf(0, kBefore));
  const auto nodes = framed(framer, bytesOf(kBefore + 50, kNodes + 50));
  ASSERT_GT(nodes.size(), 15U);
  EXPECT_TRUE(nodes[0].restarted);
  EXPECT_TRUE(same(nodes.back().node, nodeOf(kNodes + 49)));
  EXPECT_EQ(framer.counters().nodes + framer.counters().dropped, kNodes + 50);
}

TEST(NodeFramer, AFewWholeNodesPassForUnsteadyTurning) {
  NodeFramer framer;
  framed(framer, bytesOf(0, kBefore));
  EXPECT_EQ(framed(framer, bytesOf(kBefore + 7, kNodes)).size(), kNodes - kBefore - 7);
  EXPECT_EQ(framer.counters().dropped, 0U);
}

TEST(NodeFramer, GarbageIsLeftOut) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    NodeFramer framer;
    framed(framer, bytesOf(0, kBefore));
    Bytes bytes(random() % 30);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    append(bytes, bytesOf(kBefore, kNodes));
    const auto nodes = framed(framer, bytes);
    std::uint64_t next = kNodes;
    for (auto node = nodes.rbegin(); node != nodes.rend() && same(node->node, nodeOf(next - 1)); ++node)
      --next;
    // The last bytes of the garbage may pass for the first ones of a node.
    EXPECT_LE(next, kBefore + 2) << "trial " << trial;
    EXPECT_LE(nodes.size(), kNodes - kBefore + 2) << "trial " << trial;
  }
}

TEST(NodeFramer, RandomBytesAreNoScan) {
  NodeFramer framer;
  std::mt19937 random(5);
  Bytes garbage(1000000);
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
  EXPECT_LT(framed(framer, garbage).size(), 20U);
  EXPECT_EQ(framed(framer, bytesOf(0, 100)).size(), 100U) << "and it is found behind them";
}

TEST(NodeFramer, AScanThatWasBegunAgainStartsANewCount) {
  NodeFramer framer;
  framed(framer, bytesOf(0, 100));
  framer.reset();
  const auto nodes = framed(framer, bytesOf(50, 100));
  ASSERT_EQ(nodes.size(), 50U);
  EXPECT_TRUE(nodes[0].restarted);
  EXPECT_FALSE(nodes[1].restarted);
  EXPECT_EQ(framer.counters().dropped, 0U);
}

TEST(NodeFramer, JumpsOfTheHeadingAtEdgesAreNodes) {
  NodeFramer framer;
  std::size_t delivered = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    ScanNode node = nodeOf(k);
    const bool near = k % 60 > 30;  // the triangulation of near objects: some degrees ahead
    node.heading_deg = std::fmod(node.heading_deg + (near ? 5.0 : 0.0), 360.0);
    Bytes bytes(rplidar::kNodeBytes);
    rplidar::encodeNode(node, bytes.data());
    delivered += framed(framer, bytes).size();
  }
  EXPECT_EQ(delivered, 2000U);
}

}  // namespace
}  // namespace stereo_nav::laser
