// A clock that is set back while a bag is recorded.
#include "stereo_nav/ros/recorded_clock.h"

#include <gtest/gtest.h>

namespace stereo_nav::ros_io {
namespace {

/// Twenty images at 10 Hz, received 5 ms after their stamps; from the tenth on the stamps run behind by
/// `set_back_s`.
std::vector<ReceivedStamp> imagesOf(double set_back_s) {
  std::vector<ReceivedStamp> images;
  for (int i = 0; i < 20; ++i) {
    const double time_s = 100.0 + 0.1 * i;
    images.push_back({ros::Time(i < 10 ? time_s : time_s - set_back_s), ros::Time(time_s + 0.005)});
  }
  return images;
}

std::vector<ros::Time> stampsOf(const std::vector<ReceivedStamp>& images) {
  std::vector<ros::Time> stamps;
  for (const ReceivedStamp& image : images) stamps.push_back(image.stamp);
  return stamps;
}

TEST(RecordedClock, StampsAfterAJumpGoOnAsTheyWereReceived) {
  for (const double set_back_s : {0.5, 1.0, 60.0}) {
    const auto images = imagesOf(set_back_s);
    const RecordedClock clock(images);
    ASSERT_EQ(clock.jumps(), 1u) << set_back_s;
    std::vector<ros::Time> stamps = stampsOf(images);
    clock.straighten(stamps);
    for (int i = 0; i < 20; ++i)
      EXPECT_NEAR(stamps[static_cast<std::size_t>(i)].toSec(), 100.0 + 0.1 * i, 1e-6);
    EXPECT_NEAR(clock.offset_s(100.9), 0.0, 1e-9);
    EXPECT_NEAR(clock.offset_s(101.0), set_back_s, 1e-6);
  }
}

TEST(RecordedClock, OtherTopicsFollow) {
  const RecordedClock clock(imagesOf(1.0));
  std::vector<double> imu_s;
  for (int i = 0; i < 200; ++i) imu_s.push_back(100.0 + 0.01 * i - (i < 98 ? 0.0 : 1.0));
  clock.straighten(imu_s, [](double& time_s) -> double& { return time_s; });
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(imu_s[static_cast<std::size_t>(i)], 100.0 + 0.01 * i, 1e-6);
}

TEST(RecordedClock, LateAndUnstampedMessagesAreNoJump) {
  std::vector<ros::Time> stamps = stampsOf(imagesOf(0.0));
  std::swap(stamps[5], stamps[9]);
  stamps[12] = ros::Time();
  EXPECT_TRUE(clockJumps(stamps).empty());
  stamps[15] += ros::Duration(7.0);
  EXPECT_TRUE(clockJumps(stamps).empty()) << "one message from the future";
  EXPECT_TRUE(clockJumps({}).empty());
  EXPECT_EQ(RecordedClock(imagesOf(0.0)).jumps(), 0u);
}

TEST(RecordedClock, ItIsSetBackTwice) {
  std::vector<ReceivedStamp> images = imagesOf(1.0);
  for (std::size_t i = 15; i < images.size(); ++i) images[i].stamp -= ros::Duration(2.0);
  const RecordedClock clock(images);
  ASSERT_EQ(clock.jumps(), 2u);
  std::vector<ros::Time> stamps = stampsOf(images);
  clock.straighten(stamps);
  EXPECT_NEAR(stamps.back().toSec(), 101.9, 1e-6);
}

}  // namespace
}  // namespace stereo_nav::ros_io
