#include "odometry/thesis/thesis_odometry.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/textured_room.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kPeriod_s = 0.1;

/// Drives through the room with exact disparities; what remains is the odometry's own error.
class ThesisOdometryTest : public ::testing::Test {
 protected:
  StereoFrame frameAt(double time_s) const {
    StereoFrame frame;
    frame.left_time_s = frame.right_time_s = time_s;
    const Eigen::Isometry3d T_room_left = test::roomDrive(time_s);
    frame.left = room.render(T_room_left, calibration.fx, calibration.fy, calibration.cx, calibration.cy,
                             cv::Size(calibration.width, calibration.height));
    frame.disparity = room.disparity(T_room_left, calibration);
    return frame;
  }

  /// IMU whose axes are the camera's, attitude relative to the room.
  static ImuSample imuAt(double time_s) {
    ImuSample sample;
    sample.time_s = time_s;
    sample.q_world_imu = Eigen::Quaterniond(test::roomDrive(time_s).linear());
    return sample;
  }

  static FrameResult drive(ThesisOdometry& odometry, const std::vector<StereoFrame>& frames, bool with_imu) {
    FrameResult result;
    for (const StereoFrame& frame : frames) {
      if (with_imu) odometry.addImu(imuAt(frame.left_time_s));
      result = odometry.process(frame);
    }
    return result;
  }

  std::vector<StereoFrame> course(int count) const {
    std::vector<StereoFrame> frames;
    for (int i = 0; i < count; ++i) frames.push_back(frameAt(kPeriod_s * i));
    return frames;
  }

  test::TexturedRoom room;
  vision::StereoCalibration calibration = test::roomCalibration();
};

TEST_F(ThesisOdometryTest, FollowsADriveWithImuRotation) {
  ThesisOdometry odometry({}, calibration, Eigen::Matrix3d::Identity());
  const FrameResult result = drive(odometry, course(10), true);
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  const Eigen::Isometry3d truth = test::roomDrive(9 * kPeriod_s);
  EXPECT_LT((result.T_start_camera.translation() - truth.translation()).norm(), 0.04);
  // 0.36 m driven: the map is read at whole pixels, and far points weigh as much as near ones in the mean.
  EXPECT_TRUE(result.T_start_camera.linear().isApprox(truth.linear(), 1e-9));  // the IMU's, exactly
  EXPECT_GE(result.inliers, 50u);
}

TEST_F(ThesisOdometryTest, FollowsADriveFromVisionAlone) {
  ThesisOdometry odometry({}, calibration, Eigen::Matrix3d::Identity());
  const FrameResult result = drive(odometry, course(10), false);
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  const Eigen::Isometry3d truth = test::roomDrive(9 * kPeriod_s);
  const Eigen::Isometry3d error = truth.inverse() * result.T_start_camera;
  EXPECT_LT(error.translation().norm(), 0.01);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.2 * M_PI / 180.0);
}

TEST_F(ThesisOdometryTest, TheImuExtrinsicRotationIsApplied) {
  // The IMU sits turned: its samples must be mapped before they mean anything to the camera.
  const Eigen::Matrix3d R_camera_imu =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  ThesisOdometry odometry({}, calibration, R_camera_imu);
  FrameResult result;
  for (const StereoFrame& frame : course(4)) {
    ImuSample sample = imuAt(frame.left_time_s);
    sample.q_world_imu = Eigen::Quaterniond(test::roomDrive(frame.left_time_s).linear() * R_camera_imu);
    odometry.addImu(sample);
    result = odometry.process(frame);
  }
  EXPECT_TRUE(result.T_start_camera.linear().isApprox(test::roomDrive(3 * kPeriod_s).linear(), 1e-9));
}

TEST_F(ThesisOdometryTest, FramesWithoutDisparityOrFeaturesAreReportedAndNeverMotion) {
  ThesisOdometry odometry({}, calibration, Eigen::Matrix3d::Identity());
  EXPECT_EQ(odometry.process(frameAt(0.0)).state, State::kInitialising);
  StereoFrame unknown = frameAt(0.1);
  unknown.disparity.setTo(-1.0F);
  StereoFrame dark = frameAt(0.2);
  dark.left.setTo(3);
  StereoFrame without_map = frameAt(0.3);
  without_map.disparity = cv::Mat();
  for (const StereoFrame& frame : {unknown, dark, without_map}) {
    const FrameResult result = odometry.process(frame);
    EXPECT_EQ(result.state, State::kLost);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_TRUE(result.T_start_camera.isApprox(Eigen::Isometry3d::Identity()));
  }
  // The last good frame is still the reference: the gap is bridged.
  const FrameResult result = odometry.process(frameAt(0.4));
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT((result.T_start_camera.translation() - test::roomDrive(0.4).translation()).norm(), 0.01);
}

TEST_F(ThesisOdometryTest, ImuRotationRequiredButMissingIsLost) {
  ThesisParams params;
  params.rotation = ThesisParams::Rotation::kImu;
  ThesisOdometry odometry(params, calibration, Eigen::Matrix3d::Identity());
  const FrameResult result = drive(odometry, course(2), false);
  EXPECT_EQ(result.state, State::kLost);
  EXPECT_NE(result.reason.find("IMU"), std::string::npos);
}

TEST_F(ThesisOdometryTest, ResetStartsAnew) {
  ThesisOdometry odometry({}, calibration, Eigen::Matrix3d::Identity());
  drive(odometry, course(3), false);
  odometry.reset();
  const FrameResult result = odometry.process(frameAt(0.3));
  EXPECT_EQ(result.state, State::kInitialising);
  EXPECT_TRUE(result.T_start_camera.isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(ThesisOdometryTest, TwoRunsAreIdenticalToTheBit) {
  ThesisOdometry first({}, calibration, Eigen::Matrix3d::Identity());
  ThesisOdometry second({}, calibration, Eigen::Matrix3d::Identity());
  const auto frames = course(5);
  EXPECT_EQ(drive(first, frames, false).T_start_camera.matrix(),
            drive(second, frames, false).T_start_camera.matrix());
}

TEST_F(ThesisOdometryTest, RefusesImagesOfAnotherSize) {
  ThesisOdometry odometry({}, calibration, Eigen::Matrix3d::Identity());
  StereoFrame frame = frameAt(0.0);
  frame.left = frame.left.rowRange(0, 200);
  EXPECT_THROW(odometry.process(frame), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::odometry
