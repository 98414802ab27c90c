// A drive through the textured room with an IMU that cannot be believed.
#include "odometry/method/watched_odometry.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/angles.h"
#include "support/textured_room.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kFramePeriod_s = 0.1;
constexpr int kFrameCount = 36;  // 3.5 s, in which the rig turns by 35 degrees
/// The camera turns about its y axis, which points down.
const Eigen::Vector3d kTurnRate(0.0, 10.0 / kDegPerRad, 0.0);

const std::vector<StereoFrame>& drive() {
  static const std::vector<StereoFrame> frames = [] {
    std::vector<StereoFrame> made;
    for (int i = 0; i < kFrameCount; ++i) {
      StereoFrame frame;
      frame.left_time_s = frame.right_time_s = kFramePeriod_s * i;
      const Eigen::Isometry3d T_room_left = test::roomDrive(frame.left_time_s);
      const auto pair = test::TexturedRoom().renderPair(T_room_left, T_room_left, test::roomCalibration());
      frame.left = pair.left;
      frame.right = pair.right;
      made.push_back(frame);
    }
    return made;
  }();
  return frames;
}

using RateOf = std::function<Eigen::Vector3d(double time_s)>;

template <class AnyOdometry>
std::vector<FrameResult> follow(AnyOdometry& odometry, const RateOf& sent) {
  std::vector<FrameResult> results;
  double imu_s = -0.05;
  for (const StereoFrame& frame : drive()) {
    for (; imu_s < frame.left_time_s + 0.01; imu_s += 0.01) {
      ImuSample sample;
      sample.time_s = imu_s;
      sample.angular_velocity = sent(imu_s);
      odometry.addImu(sample);
    }
    results.push_back(odometry.process(frame));
  }
  return results;
}

double endError_m(const FrameResult& last) {
  const Eigen::Isometry3d truth =
      test::roomDrive(0.0).inverse() * test::roomDrive(drive().back().left_time_s);
  return (last.T_start_camera.translation() - truth.translation()).norm();
}

WatchedOdometry watched() {
  return {OdometryConfig(), test::roomCalibration(), SensorAxes()};
}

TEST(WatchedOdometry, WithAGoodImuItIsTheOdometryAlone) {
  const RateOf good = [](double) { return kTurnRate; };
  WatchedOdometry odometry = watched();
  const auto results = follow(odometry, good);
  const auto alone = makeOdometry(OdometryConfig(), test::roomCalibration(), Eigen::Matrix3d::Identity());
  const auto expected = follow(*alone, good);
  EXPECT_EQ(odometry.imuProblem(), "");
  for (std::size_t i = 0; i < results.size(); ++i)
    EXPECT_EQ(results[i].T_start_camera.matrix(), expected[i].T_start_camera.matrix()) << i;
}

TEST(WatchedOdometry, RatesInDegreesAreSetAsideAndThePathGoesOn) {
  WatchedOdometry odometry = watched();
  const auto results = follow(odometry, [](double) -> Eigen::Vector3d { return kDegPerRad * kTurnRate; });
  EXPECT_NE(odometry.imuProblem().find("deg/s"), std::string::npos) << odometry.imuProblem();
  EXPECT_EQ(results.back().state, State::kTracking);
  EXPECT_LT(endError_m(results.back()), 0.03);  // of 1.4 m; the first frame after the start is lost
}

TEST(WatchedOdometry, AnImuThatGoesWrongInMidDriveIsSetAside) {
  WatchedOdometry odometry = watched();
  const auto results = follow(
      odometry, [](double time_s) -> Eigen::Vector3d { return time_s < 1.0 ? kTurnRate : -kTurnRate; });
  EXPECT_NE(odometry.imuProblem().find("reversed"), std::string::npos) << odometry.imuProblem();
  EXPECT_EQ(results.back().state, State::kTracking);
  EXPECT_LT(endError_m(results.back()), 0.03);
}

TEST(WatchedOdometry, AfterAResetTheImuIsTriedAgain) {
  WatchedOdometry odometry = watched();
  follow(odometry, [](double) -> Eigen::Vector3d { return kDegPerRad * kTurnRate; });
  ASSERT_NE(odometry.imuProblem(), "");
  odometry.reset();
  EXPECT_EQ(odometry.imuProblem(), "");
  const auto results = follow(odometry, [](double) { return kTurnRate; });
  EXPECT_EQ(odometry.imuProblem(), "");
  EXPECT_LT(endError_m(results.back()), 0.03);
}

}  // namespace
}  // namespace stereo_nav::odometry
