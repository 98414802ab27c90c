#include "core/planar_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stereo_nav/core/lie.h"

namespace stereo_nav {
namespace {

const Eigen::Vector3d kTwists[] = {{0.3, -0.2, 1.1}, {0.3, -0.2, -3.0}, {1.0, 2.0, 1e-7}, {-1.0, 0.5, 0.0}};

TEST(PlanarMotion, IsTheMotionInSpaceThatStaysInThePlane) {
  for (const Eigen::Vector3d& twist : kTwists) {
    Vector6d spatial;
    spatial << twist.x(), twist.y(), 0.0, 0.0, 0.0, twist.z();
    const Eigen::Isometry3d T = expMotion(spatial);
    const Eigen::Isometry2d planar = expPlanar(twist);
    EXPECT_LT((planar.linear() - T.linear().topLeftCorner<2, 2>()).norm(), 1e-12);
    EXPECT_LT((planar.translation() - T.translation().head<2>()).norm(), 1e-9);
  }
}

TEST(PlanarMotion, LogarithmUndoesTheExponential) {
  for (const Eigen::Vector3d& twist : kTwists) {
    EXPECT_LT((logPlanar(expPlanar(twist)) - twist).norm(), 1e-9) << twist.transpose();
  }
}

TEST(PlanarMotion, AdjointCarriesASmallMotionOver) {
  const Eigen::Isometry2d T = expPlanar({2.0, -1.0, 0.7});
  const Eigen::Vector3d d(0.1, 0.2, -0.3);
  EXPECT_TRUE((T * expPlanar(d)).isApprox(expPlanar(adjointPlanar(T) * d) * T, 1e-9));
}

TEST(PlanarMotion, LeftJacobianMatchesNumericDifferences) {
  constexpr double kDifference = 1e-6;
  for (const Eigen::Vector3d& twist : kTwists) {
    const Eigen::Isometry2d T_inverse = expPlanar(twist).inverse();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d e = kDifference * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d numeric =
          (logPlanar(expPlanar(twist + e) * T_inverse) - logPlanar(expPlanar(twist - e) * T_inverse)) /
          (2.0 * kDifference);
      EXPECT_LT((numeric - leftJacobianPlanar(twist).col(k)).norm(), 1e-8) << twist.transpose() << ", " << k;
    }
  }
}

}  // namespace
}  // namespace stereo_nav
