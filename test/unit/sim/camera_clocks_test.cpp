#include "sim/camera_clocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace stereo_nav::sim {
namespace {

TEST(CameraClocks, WithoutFaultsPairsAreSimultaneousAndEven) {
  const auto pairs = pairInstants(TimingParams(), 10.0, 1);
  ASSERT_EQ(pairs.size(), 301u);
  for (const PairInstants& pair : pairs) EXPECT_EQ(pair.left_s, pair.right_s);
  EXPECT_NEAR(pairs[300].left_s, 10.0, 1e-9);
  EXPECT_EQ(pairs.back().pairs_dropped, 0u);
}

TEST(CameraClocks, AConstantSkewIsKeptUpToHalfAPeriod) {
  TimingParams timing;
  timing.time_offset_ms = 16.0;
  for (const PairInstants& pair : pairInstants(timing, 2.0, 1))
    EXPECT_NEAR(pair.right_s - pair.left_s, 0.016, 1e-12);
  timing.time_offset_ms = 20.0;  // more than half a period: the right image before is nearer
  for (const PairInstants& pair : pairInstants(timing, 2.0, 1)) {
    EXPECT_NEAR(pair.right_s - pair.left_s, 0.020 - 1.0 / 30.0, 1e-9);
  }
}

TEST(CameraClocks, JitterHasItsSpread) {
  TimingParams timing;
  timing.jitter_ms = 2.0;
  const auto pairs = pairInstants(timing, 60.0, 1);
  double squares = 0.0;
  for (const PairInstants& pair : pairs) squares += std::pow(pair.right_s - pair.left_s, 2.0);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(pairs.size())), 0.002 * std::sqrt(2.0), 2e-4);
}

TEST(CameraClocks, FreeRunningCamerasDriftThroughAllSkewsAndNeverShareAnImage) {
  TimingParams timing;
  timing.free_running = true;
  timing.clock_ppm = 2000.0;  // a whole period in 17 s
  timing.jitter_ms = 1.0;
  const auto pairs = pairInstants(timing, 60.0, 2);
  std::set<std::uint32_t> right_images;
  double least = 1.0, most = -1.0;
  for (const PairInstants& pair : pairs) {
    const double skew_s = pair.right_s - pair.left_s;
    EXPECT_LE(std::fabs(skew_s), 0.5 / 30.0);
    EXPECT_TRUE(right_images.insert(pair.right_sequence).second);
    least = std::min(least, skew_s);
    most = std::max(most, skew_s);
  }
  EXPECT_LT(least, -0.016);
  EXPECT_GT(most, 0.016);
  EXPECT_EQ(pairs.back().left_sequence + 1u, pairs.size() + pairs.back().pairs_dropped);
  EXPECT_GT(pairs.back().pairs_dropped, 0u);
  EXPECT_NE(pairs[0].right_s, pairInstants(timing, 60.0, 3)[0].right_s);
}

}  // namespace
}  // namespace stereo_nav::sim
