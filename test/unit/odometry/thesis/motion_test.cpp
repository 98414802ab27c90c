#include "odometry/thesis/motion.h"

#include <gtest/gtest.h>

#include <random>

namespace stereo_nav::odometry {
namespace {

vision::StereoCalibration calibration() {
  vision::StereoCalibration c;
  c.fx = 450.0;
  c.fy = 440.0;
  c.cx = 320.0;
  c.cy = 240.0;
  c.right_cx = 318.0;
  c.baseline_m = 0.11;
  c.width = 640;
  c.height = 480;
  return c;
}

Eigen::Isometry3d exampleMotion() {
  Eigen::Isometry3d T_current_previous = Eigen::Isometry3d::Identity();
  T_current_previous.linear() =
      Eigen::AngleAxisd(0.05, Eigen::Vector3d(0.2, 1.0, -0.3).normalized()).toRotationMatrix();
  T_current_previous.translation() << 0.02, -0.01, -0.12;
  return T_current_previous;
}

/// Points in view, moved exactly, then seen with pixel noise in the current frame.
std::vector<PointPair> scene(std::size_t count, const Eigen::Isometry3d& T_current_previous, double noise_px,
                             unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(40.0, 600.0);
  std::uniform_real_distribution<double> v(40.0, 440.0);
  std::uniform_real_distribution<double> depth(1.0, 8.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  const vision::StereoCalibration c = calibration();
  std::vector<PointPair> pairs;
  while (pairs.size() < count) {
    const Eigen::Vector3d p_previous =
        c.backProject(u(random), v(random), c.fx * c.baseline_m / depth(random));
    Eigen::Vector3d pixels = c.project(T_current_previous * p_previous);
    for (int k = 0; k < 3; ++k) pixels[k] += noise_px * noise(random);
    const double disparity_px = (pixels.x() - c.cx) - (pixels.z() - c.right_cx);
    if (disparity_px < 1.0) continue;
    pairs.push_back({p_previous, c.backProject(pixels.x(), pixels.y(), disparity_px)});
  }
  return pairs;
}

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(MeanTranslation, IsTheDisplacementInTheCurrentFrame) {
  const Eigen::Isometry3d T_current_previous = exampleMotion();
  const auto pairs = scene(20, T_current_previous, 0.0, 1);
  const Eigen::Vector3d t = meanTranslation(T_current_previous.linear(), pairs);
  // b = R a + translation, so R a - b is what the camera moved, seen from where it is now.
  EXPECT_TRUE(t.isApprox(-T_current_previous.translation(), 1e-9)) << t.transpose();
}

TEST(AlignPoints, RecoversAnExactMotion) {
  const Eigen::Isometry3d T_current_previous = exampleMotion();
  EXPECT_TRUE(alignPoints(scene(3, T_current_previous, 0.0, 2)).isApprox(T_current_previous, 1e-9));
}

TEST(ReprojectionJacobian, AgreesWithNumericDifferences) {
  const Eigen::Isometry3d T_current_previous = exampleMotion();
  for (const PointPair& pair : scene(10, T_current_previous, 1.0, 3)) {
    Eigen::Matrix<double, 3, 6> jacobian;
    reprojectionResidual(calibration(), pair, T_current_previous, &jacobian);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      Eigen::Matrix<double, 6, 1> delta = Eigen::Matrix<double, 6, 1>::Zero();
      delta[k] = kStep;
      const Eigen::Vector3d ahead =
          reprojectionResidual(calibration(), pair, expMotion(delta) * T_current_previous, nullptr);
      const Eigen::Vector3d behind =
          reprojectionResidual(calibration(), pair, expMotion(-delta) * T_current_previous, nullptr);
      const Eigen::Vector3d numeric = (ahead - behind) / (2.0 * kStep);
      EXPECT_LT((numeric - jacobian.col(k)).norm(), 1e-4 * std::max(1.0, numeric.norm()))
          << "parameter " << k;
    }
  }
}

TEST(RefineMotion, ConvergesFromAFarStartAndRejectsWrongPairs) {
  const Eigen::Isometry3d T_current_previous = exampleMotion();
  auto pairs = scene(60, T_current_previous, 0.0, 4);
  for (std::size_t i = 0; i < 10; ++i) pairs[i].p_current += Eigen::Vector3d(0.3, 0.2, -0.4);
  const RefinedMotion motion = refineMotion({}, calibration(), pairs, Eigen::Isometry3d::Identity());
  ASSERT_TRUE(motion.converged);
  EXPECT_EQ(motion.inliers, 50u);
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(motion.inlier[i], i >= 10);
  EXPECT_LT((motion.T_current_previous.translation() - T_current_previous.translation()).norm(), 1e-6);
  EXPECT_LT(angleBetween(motion.T_current_previous, T_current_previous), 1e-7);
}

TEST(RefineMotion, CovarianceIsThatOfTheErrors) {
  const Eigen::Isometry3d T_current_previous = exampleMotion();
  constexpr int kRuns = 400;
  double normalised_squares = 0.0;
  for (unsigned run = 0; run < kRuns; ++run) {
    const auto pairs = scene(80, T_current_previous, 0.3, 100 + run);
    const RefinedMotion motion = refineMotion({}, calibration(), pairs, T_current_previous);
    ASSERT_TRUE(motion.converged);
    // Left perturbation that leads from the truth to the estimate; angles are small.
    const Eigen::Isometry3d error = motion.T_current_previous * T_current_previous.inverse();
    Eigen::Matrix<double, 6, 1> delta;
    const Eigen::AngleAxisd rotation(error.linear());
    delta << error.translation(), rotation.angle() * rotation.axis();
    normalised_squares += delta.dot(motion.covariance.ldlt().solve(delta));
  }
  // The mean of a chi-square with 6 degrees of freedom is 6; its standard error over 400 runs is 0.17.
  EXPECT_NEAR(normalised_squares / kRuns, 6.0, 0.6);
}

TEST(RefineMotion, TooFewPairsAreNoMotion) {
  const auto pairs = scene(2, exampleMotion(), 0.0, 5);
  EXPECT_FALSE(refineMotion({}, calibration(), pairs, Eigen::Isometry3d::Identity()).converged);
}

}  // namespace
}  // namespace stereo_nav::odometry
