#include "stereo_nav/estimation/odom_covariance.h"

#include <gtest/gtest.h>

namespace stereo_nav::estimation {
namespace {

const Eigen::Isometry3d kCameraAtBase = Eigen::Isometry3d::Identity();

odometry::FrameResult measured(double yaw_sigma_rad) {
  odometry::FrameResult result;
  result.state = odometry::State::kTracking;
  result.motion_covariance(5, 5) = yaw_sigma_rad * yaw_sigma_rad;
  return result;
}

TEST(OdomCovariance, StartsWithTheFloorOfOneMotion) {
  UncertaintyParams params;
  params.min_translation_sigma_m = 0.01;
  params.min_rotation_sigma_rad = 0.02;
  OdomCovariance covariance(params, kCameraAtBase);
  const Matrix6d started = covariance.start(Eigen::Matrix3d::Identity(), Matrix6d::Zero());
  EXPECT_NEAR(started(0, 0), 1e-4, 1e-12);
  EXPECT_NEAR(started(5, 5), 4e-4, 1e-12);
  EXPECT_TRUE(covariance.pose(Eigen::Matrix3d::Identity()).isApprox(started));
}

TEST(OdomCovariance, AnUncertainHeadingBecomesASidewaysError) {
  UncertaintyParams params;
  params.min_translation_sigma_m = params.min_rotation_sigma_rad = 1e-6;
  OdomCovariance covariance(params, kCameraAtBase);
  Matrix6d heading = Matrix6d::Zero();
  heading(5, 5) = 0.1 * 0.1;
  covariance.start(Eigen::Matrix3d::Identity(), heading);
  Eigen::Isometry3d ahead = Eigen::Isometry3d::Identity();
  ahead.translation().x() = 2.0;
  covariance.addMotion(measured(0.0), ahead, 0.1);
  const Matrix6d pose = covariance.pose(Eigen::Matrix3d::Identity());
  EXPECT_NEAR(pose(1, 1), 0.2 * 0.2, 1e-9);  // 2 m ahead, 0.1 rad off: 0.2 m to the side
  EXPECT_NEAR(pose(0, 0), 0.0, 1e-9);
  EXPECT_NEAR(pose(1, 5), 0.2 * 0.1, 1e-9);
}

TEST(OdomCovariance, WithoutAMotionTheVelocityIsUnknown) {
  UncertaintyParams params;
  params.lost_speed_m_s = 2.0;
  params.lost_turn_rate_rad_s = 0.5;
  const OdomCovariance unmoved(params, kCameraAtBase);
  EXPECT_NEAR(unmoved.unknownTwist()(0, 0), 4.0, 1e-12);
  OdomCovariance covariance(params, kCameraAtBase);
  covariance.start(Eigen::Matrix3d::Identity(), Matrix6d::Zero());
  odometry::FrameResult lost;
  lost.state = odometry::State::kLost;
  const Matrix6d motion = covariance.addMotion(lost, Eigen::Isometry3d::Identity(), 0.1);
  EXPECT_NEAR(motion(0, 0), 0.2 * 0.2, 1e-12);
  EXPECT_NEAR(motion(3, 3), 0.05 * 0.05, 1e-12);
}

}  // namespace
}  // namespace stereo_nav::estimation
