#include "stereo_nav/estimation/odom_covariance.h"

#include <gtest/gtest.h>

namespace stereo_nav::estimation {
namespace {

const Eigen::Isometry3d kCameraAtBase = Eigen::Isometry3d::Identity();
const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

/// Ahead along x by so much, without any noise.
odometry::FrameResult ahead(double way_m) {
  odometry::FrameResult result;
  result.state = odometry::State::kTracking;
  result.T_previous_current.translation().x() = way_m;
  return result;
}

odometry::FrameResult lost() {
  odometry::FrameResult result;
  result.state = odometry::State::kLost;
  return result;
}

UncertaintyParams perfectCalibration() {
  UncertaintyParams params;
  params.baseline_sigma_share = params.column_offset_sigma_px = 0.0;
  params.distortion_sigma_px = params.focal_sigma_share = params.mounting_sigma_rad = 0.0;
  return params;
}

class OdomCovarianceTest : public testing::Test {
 protected:
  static OdomCovariance started(const UncertaintyParams& params) {
    OdomCovariance covariance(params, kCameraAtBase);
    covariance.start(kLevel, Matrix6d::Zero());
    return covariance;
  }
  static void add(OdomCovariance& covariance, const odometry::FrameResult& result) {
    covariance.addMotion(result, result.T_previous_current, 0.1);
  }
};

TEST_F(OdomCovarianceTest, StartsSmallButInvertible) {
  OdomCovariance covariance(UncertaintyParams(), kCameraAtBase);
  const Matrix6d started = covariance.start(kLevel, Matrix6d::Zero());
  EXPECT_GT(started.ldlt().vectorD().minCoeff(), 0.0);
  EXPECT_LT(started(0, 0), 1e-10);
  EXPECT_TRUE(covariance.pose(kLevel).isApprox(started));
}

TEST_F(OdomCovarianceTest, AnUncertainHeadingBecomesASidewaysError) {
  OdomCovariance covariance(perfectCalibration(), kCameraAtBase);
  Matrix6d heading = Matrix6d::Zero();
  heading(5, 5) = 0.1 * 0.1;
  covariance.start(kLevel, heading);
  add(covariance, ahead(2.0));
  const Matrix6d pose = covariance.pose(kLevel);
  EXPECT_NEAR(pose(1, 1), 0.2 * 0.2, 1e-9);  // 2 m ahead, 0.1 rad off: 0.2 m to the side
  EXPECT_NEAR(pose(0, 0), 0.0, 1e-9);
  EXPECT_NEAR(pose(1, 5), 0.2 * 0.1, 1e-9);
}

TEST_F(OdomCovarianceTest, NoiseOfMotionsAddsUpAndThatOfAPoseDoesNot) {
  OdomCovariance covariance = started(perfectCalibration());
  odometry::FrameResult result;
  result.state = odometry::State::kTracking;
  result.motion_covariance(0, 0) = 1e-4;
  result.pose_noise(0, 0) = 9e-4;
  Matrix6d motion;
  for (int i = 0; i < 10; ++i) motion = covariance.addMotion(result, Eigen::Isometry3d::Identity(), 0.1);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 10 * 1e-4 + 9e-4, 1e-9);
  EXPECT_NEAR(motion(0, 0), 9e-4 + 1e-4 + 9e-4, 1e-9) << "of the pose before, of the motion, of the pose";
}

TEST_F(OdomCovarianceTest, AnUncertainFocalLengthScalesTurnsAndTheWayAlongTheView) {
  UncertaintyParams params = perfectCalibration();
  params.focal_sigma_share = 0.01;
  OdomCovariance along = started(params);
  odometry::FrameResult result = ahead(0.0);
  result.T_previous_current.translation().z() = 2.0;  // the camera looks along its z axis
  add(along, result);
  EXPECT_NEAR(along.pose(kLevel)(2, 2), 0.02 * 0.02, 1e-9);
  OdomCovariance across = started(params);
  add(across, ahead(2.0));
  EXPECT_NEAR(across.pose(kLevel)(0, 0), 0.0, 1e-9);
  OdomCovariance turning = started(params);
  result = ahead(0.0);
  result.T_previous_current.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
  add(turning, result);
  EXPECT_NEAR(turning.pose(kLevel)(4, 4), 0.005 * 0.005, 1e-9);
}

TEST_F(OdomCovarianceTest, AnUncertainBaselineMakesAnErrorThatGrowsWithTheDistance) {
  UncertaintyParams params = perfectCalibration();
  params.baseline_sigma_share = 0.01;
  OdomCovariance covariance = started(params);
  for (int i = 0; i < 100; ++i) add(covariance, ahead(0.1));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.1 * 0.1, 1e-6) << "one percent of 10 m";
  for (int i = 0; i < 100; ++i) add(covariance, ahead(-0.1));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.0, 1e-6) << "back at the start";
}

TEST_F(OdomCovarianceTest, AColumnOffsetScalesFarScenesMore) {
  UncertaintyParams params = perfectCalibration();
  params.column_offset_sigma_px = 0.2;
  OdomCovariance covariance = started(params);
  odometry::FrameResult near = ahead(5.0), far = ahead(5.0);
  near.calibration_effects(0, 0) = 5.0 / 50.0;
  far.calibration_effects(0, 0) = 5.0 / 10.0;
  add(covariance, near);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), std::pow(5.0 * 0.2 / 50.0, 2), 1e-9);
  add(covariance, far);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), std::pow(5.0 * 0.2 / 50.0 + 5.0 * 0.2 / 10.0, 2), 1e-9);
}

TEST_F(OdomCovarianceTest, LensErrorsAddUpWithTheMotionsTheyAreSeenIn) {
  UncertaintyParams params = perfectCalibration();
  params.distortion_sigma_px = 0.5;
  OdomCovariance covariance = started(params);
  odometry::FrameResult result = ahead(0.0);
  result.calibration_effects(3, 1) = 0.03;
  result.calibration_effects(3, 6) = 0.04;
  for (int i = 0; i < 10; ++i) add(covariance, result);
  EXPECT_NEAR(covariance.pose(kLevel)(3, 3), std::pow(10 * 0.5 * 0.05, 2), 1e-9);
}

TEST_F(OdomCovarianceTest, ACameraThatLooksAsideDrivesAside) {
  UncertaintyParams params = perfectCalibration();
  params.mounting_sigma_rad = 0.01;
  OdomCovariance covariance = started(params);
  for (int i = 0; i < 100; ++i) add(covariance, ahead(0.1));
  const Matrix6d pose = covariance.pose(kLevel);
  EXPECT_NEAR(pose(1, 1), 0.1 * 0.1, 1e-6) << "10 m at 0.01 rad";
  EXPECT_NEAR(pose(2, 2), 0.1 * 0.1, 1e-6);
  EXPECT_NEAR(pose(0, 0), 0.0, 1e-6);
  EXPECT_NEAR(pose(5, 5), 0.0, 1e-6) << "the heading is as measured";
}

TEST_F(OdomCovarianceTest, AnUnmeasuredVelocityIsTheSameUntilAMotionIsMeasured) {
  UncertaintyParams params = perfectCalibration();
  params.lost_speed_m_s = 2.0;
  params.lost_turn_rate_rad_s = 0.5;
  OdomCovariance covariance = started(params);
  EXPECT_NEAR(covariance.unknownTwist()(0, 0), 4.0, 1e-12);
  for (int i = 0; i < 5; ++i) add(covariance, lost());
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), std::pow(2.0 * 0.5, 2), 1e-9);
  EXPECT_NEAR(covariance.pose(kLevel)(3, 3), std::pow(0.5 * 0.5, 2), 1e-9);
  add(covariance, ahead(0.3));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.0, 1e-9) << "against the same map the pose is known again";
}

odometry::FrameResult anew() {
  odometry::FrameResult result = lost();
  result.new_map = true;
  return result;
}

TEST_F(OdomCovarianceTest, ANewMapKeepsTheUncertaintyOfTheGap) {
  OdomCovariance covariance = started(perfectCalibration());
  for (int i = 0; i < 5; ++i) add(covariance, lost());
  add(covariance, anew());
  for (int i = 0; i < 5; ++i) add(covariance, ahead(0.0));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), std::pow(0.6, 2), 1e-6) << "1 m/s for 0.6 s";
}

TEST_F(OdomCovarianceTest, ARobotThatIsFastBeforeOrAfterAGapWasFastInIt) {
  for (const bool before : {true, false}) {
    OdomCovariance covariance = started(perfectCalibration());
    add(covariance, ahead(before ? 1.0 : 0.0));
    for (int i = 0; i < 5; ++i) add(covariance, lost());
    add(covariance, anew());
    add(covariance, ahead(before ? 0.0 : 1.0));
    EXPECT_NEAR(covariance.pose(kLevel)(0, 0), (1.0 + 100.0) * std::pow(0.6, 2), 1e-3) << "10 m/s for 0.6 s";
  }
}

TEST_F(OdomCovarianceTest, ACoastingPoseHasWhatIsPredicted) {
  OdomCovariance covariance = started(perfectCalibration());
  for (int i = 1; i <= 5; ++i) {
    odometry::FrameResult coasting = ahead(0.1);
    coasting.state = odometry::State::kCoasting;
    coasting.motion_covariance(0, 0) = 0.01 * i * i;
    add(covariance, coasting);
    EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.01 * i * i, 1e-9);
  }
  odometry::FrameResult then = lost();
  then.motion_covariance(0, 0) = 0.25;
  then.turn_is_measured = true;
  add(covariance, then);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.25 + 0.01, 1e-9) << "and 1 m/s for 0.1 s";
  EXPECT_NEAR(covariance.pose(kLevel)(3, 3), 0.0, 1e-9) << "the IMU knows the turn";
  add(covariance, ahead(0.0));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.0, 1e-9) << "the old map is found again";
}

TEST_F(OdomCovarianceTest, AFirstMotionCountsOnceItIsConfirmed) {
  OdomCovariance covariance = started(perfectCalibration());
  odometry::FrameResult first = ahead(0.2);
  first.state = odometry::State::kInitialising;
  first.motion_covariance(0, 0) = 1e-4;
  add(covariance, first);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.01, 1e-6) << "1 m/s for 0.1 s";
  add(covariance, ahead(0.2));
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 1e-4, 1e-9);
}

TEST_F(OdomCovarianceTest, AFirstMotionThatIsNotConfirmedHasNotHappened) {
  OdomCovariance covariance = started(perfectCalibration());
  odometry::FrameResult first = ahead(0.2);
  first.state = odometry::State::kInitialising;
  first.motion_covariance(0, 0) = 1.0;
  add(covariance, first);
  odometry::FrameResult back = anew();
  back.T_previous_current.translation().x() = -0.2;
  add(covariance, back);
  EXPECT_NEAR(covariance.pose(kLevel)(0, 0), 0.04, 1e-6) << "1 m/s for 0.2 s";
}

}  // namespace
}  // namespace stereo_nav::estimation
