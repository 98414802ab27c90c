#include "stereo_nav/ros/pairing.h"

#include <gtest/gtest.h>

namespace stereo_nav::ros_io {
namespace {

std::vector<ros::Time> stamps(const std::vector<double>& times_s) {
  std::vector<ros::Time> result;
  for (const double time_s : times_s) result.emplace_back(100.0 + time_s);
  return result;
}

TEST(PairStamps, NearestWithinHalfAPeriodEachOnce) {
  const auto pairs = pairStamps(stamps({0.0, 0.1, 0.2, 0.3}), stamps({0.02, 0.11, 0.28, 0.31}), {});
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].right, 0u);
  EXPECT_EQ(pairs[1].right, 1u);
  // 0.28 is 80 ms from 0.2 and 20 ms from 0.3, but 0.31 is nearer to 0.3: the image at 0.2 stays alone.
  EXPECT_EQ(pairs[2].left, 3u);
  EXPECT_EQ(pairs[2].right, 3u);
  EXPECT_NEAR(pairs[0].right_time_s - pairs[0].left_time_s, 0.02, 1e-6);
  EXPECT_EQ(pairs[0].rolling_shutter_s, 0.0);
}

TEST(PairStamps, ALostImageDoesNotShiftThePairsBehindIt) {
  const auto pairs = pairStamps(stamps({0.0, 0.1, 0.2, 0.3}), stamps({0.0, 0.2, 0.3}), {});
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[1].left, 2u);
  EXPECT_EQ(pairs[1].right, 1u);
}

StereoSync syncOf(double left_s, double right_s) {
  StereoSync sync;
  sync.header.stamp = sync.left_stamp = ros::Time(100.0 + left_s);
  sync.right_stamp = ros::Time(100.0 + right_s);
  sync.rolling_shutter_s = 0.03;
  return sync;
}

TEST(PairStamps, SyncMessagesDecideAndGiveTheTrueTimes) {
  const std::vector<StereoSync> sync = {syncOf(0.0, 0.05), syncOf(0.1, 0.15)};
  // Images may carry the common stamp of the pair, or each its own.
  for (const auto& right : {stamps({0.0, 0.1}), stamps({0.05, 0.15})}) {
    const auto pairs = pairStamps(stamps({0.0, 0.1}), right, sync);
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_NEAR(pairs[1].left_time_s, 100.1, 1e-6);
    EXPECT_NEAR(pairs[1].right_time_s, 100.15, 1e-6);
    EXPECT_EQ(pairs[1].rolling_shutter_s, 0.03);
  }
}

TEST(PairStamps, NothingInReachGivesNoPair) {
  EXPECT_TRUE(pairStamps(stamps({0.0, 0.1}), stamps({5.0, 5.1}), {}).empty());
}

}  // namespace
}  // namespace stereo_nav::ros_io
