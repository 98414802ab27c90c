#include "stereo_nav/estimation/base_odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/optical_axes.h"
#include "estimation/levelling.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kTolerance = 1e-9;

/// Camera 0.2 m ahead of the base and 0.3 m above it, looking ahead.
Eigen::Isometry3d baseToCamera() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = opticalToBody();
  T.translation() << 0.2, 0.0, 0.3;
  return T;
}

Eigen::Isometry3d planar(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << x, y, 0.0;
  return T;
}

odometry::FrameResult resultFor(const Eigen::Isometry3d& T_start_base,
                                const Eigen::Isometry3d& T_previous_base) {
  const Eigen::Isometry3d T = baseToCamera();
  odometry::FrameResult result;
  result.state = odometry::State::kTracking;
  result.T_start_camera = T.inverse() * T_start_base * T;
  result.T_previous_current = T.inverse() * T_previous_base * T;
  return result;
}

BaseOdometry started() {
  BaseOdometry odometry(UncertaintyParams{}, baseToCamera());
  odometry::FrameResult first;
  odometry.update(first, 0.0);
  return odometry;
}

UncertaintyParams exactCalibration() {
  UncertaintyParams params;
  params.baseline_sigma_share = params.column_offset_sigma_px = 0.0;
  params.distortion_sigma_px = params.focal_sigma_share = params.mounting_sigma_rad = 0.0;
  return params;
}

TEST(BaseOdometry, CarriesTheCamerasMotionOverToTheBase) {
  BaseOdometry odometry = started();
  const Eigen::Isometry3d motion = planar(0.1, 0.0, 0.2);
  const BaseEstimate estimate = odometry.update(resultFor(motion, motion), 0.5);
  EXPECT_TRUE(estimate.T_odom_base.isApprox(motion, kTolerance));
}

TEST(BaseOdometry, TwistIsTheConstantVelocityThatMakesTheMotion) {
  // On a circle of radius r a robot that drives v and turns w moves by this chord.
  const double w = 0.4, v = 0.8, dt = 0.5, r = v / w;
  BaseOdometry odometry = started();
  const Eigen::Isometry3d motion = planar(r * std::sin(w * dt), r * (1.0 - std::cos(w * dt)), w * dt);
  const BaseEstimate estimate = odometry.update(resultFor(motion, motion), dt);
  Vector6d expected;
  expected << v, 0, 0, 0, 0, w;
  EXPECT_TRUE(estimate.twist.isApprox(expected, kTolerance)) << estimate.twist.transpose();
}

TEST(BaseOdometry, CameraNoiseBecomesBaseNoise) {
  const UncertaintyParams params = exactCalibration();
  BaseOdometry odometry(params, baseToCamera());
  odometry.update(odometry::FrameResult(), 0.0);
  odometry::FrameResult result = resultFor(planar(0.1, 0, 0), planar(0.1, 0, 0));
  result.motion_covariance(2, 2) = 0.04;  // along the viewing direction: the base's x
  result.motion_covariance(4, 4) = 0.01;  // about the camera's y, pointing down: the base's yaw
  const BaseEstimate estimate = odometry.update(result, 0.5);
  EXPECT_NEAR(estimate.twist_covariance(0, 0), 0.04 / 0.25, 1e-6);
  EXPECT_NEAR(estimate.twist_covariance(5, 5), 0.01 / 0.25, 1e-6);
  // Yaw about the camera moves a base 0.2 m behind it sideways.
  EXPECT_NEAR(estimate.twist_covariance(1, 1), 0.2 * 0.2 * 0.01 / 0.25, 1e-6);
}

TEST(BaseOdometry, YawNoiseSpreadsSidewaysWithDistance) {
  const UncertaintyParams params = exactCalibration();
  BaseOdometry odometry(params, Eigen::Isometry3d::Identity());
  odometry.update(odometry::FrameResult(), 0.0);
  odometry::FrameResult turned;
  turned.state = odometry::State::kTracking;
  turned.motion_covariance(5, 5) = 0.01;
  odometry.update(turned, 1.0);
  odometry::FrameResult driven;
  driven.state = odometry::State::kTracking;
  driven.T_previous_current.translation().x() = driven.T_start_camera.translation().x() = 3.0;
  const BaseEstimate estimate = odometry.update(driven, 2.0);
  EXPECT_NEAR(estimate.pose_covariance(1, 1), 9.0 * 0.01, 1e-6);
  EXPECT_NEAR(estimate.pose_covariance(0, 0), 0.0, 1e-6);
}

TEST(BaseOdometry, ALostFrameHoldsThePoseAndSpreadsTheCovariance) {
  BaseOdometry odometry = started();
  const Eigen::Isometry3d motion = planar(0.1, 0.0, 0.0);
  odometry.update(resultFor(motion, motion), 0.1);
  odometry::FrameResult lost = resultFor(motion, Eigen::Isometry3d::Identity());
  lost.state = odometry::State::kLost;
  const double before = odometry.estimate().pose_covariance(0, 0);
  const BaseEstimate estimate = odometry.update(lost, 0.2);
  EXPECT_TRUE(estimate.T_odom_base.isApprox(motion, kTolerance));
  EXPECT_TRUE(estimate.twist.isZero());
  EXPECT_NEAR(estimate.twist_covariance(0, 0), 2.0,
              kTolerance);  // (1 m/s)^2, and as much for the speed it had
  EXPECT_NEAR(estimate.pose_covariance(0, 0) - before, 0.02, kTolerance);
  // What follows may span more than one interval: a pose, but no velocity.
  const BaseEstimate after = odometry.update(resultFor(planar(0.3, 0, 0), planar(0.2, 0, 0)), 0.3);
  EXPECT_TRUE(after.twist.isZero());
  EXPECT_NEAR(after.T_odom_base.translation().x(), 0.3, kTolerance);
}

TEST(BaseOdometry, ACoastingFrameHasAVelocity) {
  BaseOdometry odometry = started();
  const Eigen::Isometry3d motion = planar(0.1, 0.0, 0.0);
  odometry.update(resultFor(motion, motion), 0.1);
  odometry::FrameResult coasting = resultFor(planar(0.2, 0.0, 0.0), motion);
  coasting.state = odometry::State::kCoasting;
  coasting.motion_covariance(2, 2) = 0.0004;  // ahead: 0.2 m/s after 0.1 s
  const BaseEstimate estimate = odometry.update(coasting, 0.2);
  EXPECT_NEAR(estimate.T_odom_base.translation().x(), 0.2, kTolerance);
  EXPECT_NEAR(estimate.twist[0], 1.0, kTolerance);
  EXPECT_NEAR(estimate.twist_covariance(0, 0), 3.0 * 0.04, kTolerance);
}

TEST(BaseOdometry, CovariancesArePositiveDefiniteFromTheStart) {
  BaseOdometry odometry = started();
  for (const auto& covariance : {odometry.estimate().pose_covariance, odometry.estimate().twist_covariance}) {
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().minCoeff(), 0.0);
  }
}

TEST(BaseOdometry, SetPoseMovesTheFrameAndMotionGoesOn) {
  BaseOdometry odometry = started();
  odometry.update(resultFor(planar(1, 0, 0), planar(1, 0, 0)), 0.1);
  odometry.setPose(planar(5, 5, M_PI / 2), Matrix6d::Identity());
  EXPECT_TRUE(odometry.estimate().T_odom_base.isApprox(planar(5, 5, M_PI / 2), kTolerance));
  const BaseEstimate estimate = odometry.update(resultFor(planar(2, 0, 0), planar(1, 0, 0)), 0.2);
  EXPECT_TRUE(estimate.T_odom_base.isApprox(planar(5, 6, M_PI / 2), kTolerance));
  EXPECT_GT(estimate.pose_covariance(0, 0), 1.0);
}

TEST(BaseOdometry, OnAFloorHeightAndTiltDoNotDrift) {
  BaseOdometry odometry(UncertaintyParams{}, baseToCamera());
  FloorParams floor;
  floor.on = true;
  odometry.setFloor(floor);
  odometry.start(planar(1.0, 2.0, 0.5), Matrix6d::Zero());
  odometry.setPose(Eigen::Translation3d(0.0, 0.0, 0.4) * planar(1.0, 2.0, 0.5), Matrix6d::Zero());
  Eigen::Isometry3d T_start_base = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d climbing = planar(0.1, 0.0, 0.0);  // by a pitch that is 0.001 deg wrong in each frame
  climbing.linear() = Eigen::AngleAxisd(-0.001 * M_PI / 180.0, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (int frame = 0; frame < 300; ++frame) {
    odometry::FrameResult result =
        resultFor(T_start_base, frame == 0 ? Eigen::Isometry3d::Identity() : climbing);
    result.motion_covariance = 1e-7 * Matrix6d::Identity();
    odometry.update(result, 0.1 * frame);
    T_start_base = T_start_base * climbing;
  }
  EXPECT_GT(T_start_base.translation().z(), 0.07);
  const BaseEstimate& estimate = odometry.estimate();
  EXPECT_NEAR(estimate.T_odom_base.translation().z(), 0.4, 0.002) << "the floor is where the pose was set";
  EXPECT_LT(std::acos(estimate.T_odom_base.linear()(2, 2)), 0.005);
  EXPECT_LT(std::sqrt(estimate.pose_covariance(2, 2)), 0.0051);
}

TEST(Levelling, FromAttitudeAndFromAcceleration) {
  const Eigen::Matrix3d R_world_base =
      (Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  const Eigen::Matrix3d R_base_imu =
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d R_world_imu = R_world_base * R_base_imu;

  RotationHistory attitudes, accelerations;
  for (double time_s = 0.0; time_s < 1.15; time_s += 0.1) {
    ImuSample sample;
    sample.time_s = time_s;
    // A heading of its own does not matter.
    sample.q_world_imu =
        Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R_world_imu);
    attitudes.add(sample);
    sample.q_world_imu.reset();
    sample.angular_velocity = Eigen::Vector3d::Zero();
    sample.linear_acceleration = R_world_imu.transpose() * Eigen::Vector3d(0, 0, 9.81);
    accelerations.add(sample);
  }
  for (const auto* history : {&attitudes, &accelerations}) {
    const auto level = levelledAttitude(*history, 1.0, R_base_imu);
    ASSERT_TRUE(level);
    EXPECT_TRUE(level->isApprox(R_world_base, 1e-9));
  }
  EXPECT_FALSE(levelledAttitude(RotationHistory(), 1.0, R_base_imu));
}

}  // namespace
}  // namespace stereo_nav::estimation
