#include "odometry/stereo/pose_estimator.h"

#include <gtest/gtest.h>

#include "support/textured_room.h"
#include "synthetic_map.h"

namespace stereo_nav::odometry {
namespace {

class PoseEstimatorTest : public ::testing::Test {
 protected:
  PoseEstimatorTest() {
    twist << 0.5, -0.2, -1.0, 0.1, 0.3, -0.2;
    truth.T_camera_world = expMotion(twist * interval_s);
  }

  std::vector<MapObservation> observations(double sigma_px) {
    std::vector<MapObservation> result;
    for (const Eigen::Vector3d& p : test::pointsAhead(100, 3)) {
      result.push_back({p, test::observe(calibration, truth, p, sigma_px, random)});
    }
    return result;
  }

  MotionPrior prior() const {
    MotionPrior prior;
    prior.interval_s = interval_s;
    return prior;
  }

  double interval_s = 0.1;
  Vector6d twist;
  vision::StereoCalibration calibration = test::roomCalibration();
  vision::StereoView truth;
  std::mt19937 random{5};
  PoseEstimator estimator{PoseEstimatorParams(), calibration};
};

TEST_F(PoseEstimatorTest, FindsAKnownMotionExactly) {
  const PoseEstimate estimate = estimator.estimate(observations(0.0), prior(), vision::StereoView());
  ASSERT_TRUE(estimate.converged);
  EXPECT_EQ(estimate.inliers, 100u);
  EXPECT_LT(logMotion(estimate.view.T_camera_world * truth.T_camera_world.inverse()).norm(), 1e-6);
}

TEST_F(PoseEstimatorTest, IsNotMovedByAThirdOfOutliers) {
  auto seen = observations(0.2);
  std::uniform_real_distribution<double> off(-40.0, 40.0);
  for (std::size_t i = 0; i < 33; ++i) seen[i].seen.left_px += Eigen::Vector2d(off(random), off(random));
  const PoseEstimate estimate = estimator.estimate(seen, prior(), vision::StereoView());
  ASSERT_TRUE(estimate.converged);
  EXPECT_GE(estimate.inliers, 65u);
  EXPECT_LE(estimate.inliers, 70u);
  const Vector6d error = logMotion(estimate.view.T_camera_world * truth.T_camera_world.inverse());
  EXPECT_LT(error.head<3>().norm(), 0.01);
  EXPECT_LT(error.tail<3>().norm(), 0.002);
}

TEST_F(PoseEstimatorTest, TheCovarianceTellsTheError) {
  double normalised = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const PoseEstimate estimate = estimator.estimate(observations(0.3), prior(), vision::StereoView());
    ASSERT_TRUE(estimate.converged);
    const Vector6d error = logMotion(estimate.view.T_camera_world * truth.T_camera_world.inverse());
    normalised += error.dot(estimate.covariance.ldlt().solve(error)) / kRuns;
  }
  // 6 degrees of freedom: the mean of 200 chi-square values is 6 +- 0.25.
  EXPECT_GT(normalised, 5.0);
  EXPECT_LT(normalised, 7.0);
}

TEST_F(PoseEstimatorTest, FindsTheMotionBetweenSkewedStamps) {
  constexpr double kSkew_s = 0.05;
  truth.T_late_camera = expMotion(twist * kSkew_s);
  MotionPrior skewed = prior();
  skewed.right_time_offset_s = kSkew_s;
  skewed.previous_twist = 0.9 * twist;
  const PoseEstimate estimate = estimator.estimate(observations(0.0), skewed, vision::StereoView());
  ASSERT_TRUE(estimate.converged);
  EXPECT_LT(logMotion(estimate.view.T_camera_world * truth.T_camera_world.inverse()).norm(), 1e-3);
  EXPECT_LT(logMotion(estimate.view.T_late_camera * truth.T_late_camera.inverse()).norm(), 1e-3);
}

TEST_F(PoseEstimatorTest, FollowsASharpRotationPrior) {
  MotionPrior with_imu = prior();
  with_imu.R_current_previous = truth.T_camera_world.linear();
  with_imu.rotation_sigma_rad = 1e-6;
  const PoseEstimate estimate = estimator.estimate(observations(1.0), with_imu, vision::StereoView());
  ASSERT_TRUE(estimate.converged);
  EXPECT_LT(
      logRotation(estimate.view.T_camera_world.linear() * truth.T_camera_world.linear().transpose()).norm(),
      1e-5);
}

TEST_F(PoseEstimatorTest, TooFewPointsAreNoMotion) {
  auto seen = observations(0.0);
  seen.resize(2);
  EXPECT_FALSE(estimator.estimate(seen, prior(), vision::StereoView()).converged);
  EXPECT_FALSE(estimator.estimate({}, prior(), vision::StereoView()).converged);
}

}  // namespace
}  // namespace stereo_nav::odometry
