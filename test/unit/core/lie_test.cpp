#include "stereo_nav/core/lie.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereo_nav {
namespace {

constexpr double kStep = 1e-6;

Vector6d someTwist() {
  Vector6d twist;
  twist << 0.1, -0.05, 0.3, 0.02, -0.04, 0.03;
  return twist;
}

Eigen::Isometry3d planar(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << x, y, 0.0;
  return T;
}

TEST(Lie, HatIsTheCrossProduct) {
  const Eigen::Vector3d v(1.0, 2.0, 3.0), w(-0.5, 4.0, 0.25);
  EXPECT_TRUE((hat(v) * w).isApprox(v.cross(w), 1e-15));
  EXPECT_TRUE(hat(v).transpose().isApprox(-hat(v)));
}

TEST(Lie, RotationOfAQuarterTurn) {
  const Eigen::Matrix3d R = expRotation({0.0, 0.0, 0.5 * M_PI});
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(expQuaternion({0.0, 0.0, 0.5 * M_PI}).toRotationMatrix().isApprox(R, 1e-12));
}

TEST(Lie, LogarithmUndoesTheRotation) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  for (const double angle : {0.0, 1e-9, 1e-6, 1e-3, 1.0, 3.0, 3.1415}) {
    EXPECT_LT((logRotation(expRotation(angle * axis)) - angle * axis).norm(), 1e-9) << angle;
    EXPECT_LT((logRotation(expQuaternion(angle * axis)) - angle * axis).norm(), 1e-9) << angle;
  }
  // Both signs of a quaternion are one rotation; the logarithm takes the short way.
  const Eigen::Quaterniond q = expQuaternion(4.0 * axis);
  EXPECT_LT((logRotation(q) - (4.0 - 2.0 * M_PI) * axis).norm(), 1e-9);
}

TEST(Lie, LeftJacobianOfRotationMatchesNumericDifferences) {
  for (const Eigen::Vector3d& angle : {Eigen::Vector3d(0.3, -0.8, 1.1), Eigen::Vector3d(1e-8, 0.0, -1e-8)}) {
    const Eigen::Matrix3d R_inverse = expRotation(angle).transpose();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d e = kStep * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d numeric = (logRotation(expRotation(angle + e) * R_inverse) -
                                       logRotation(expRotation(angle - e) * R_inverse)) /
                                      (2.0 * kStep);
      EXPECT_LT((numeric - leftJacobian(angle).col(k)).norm(), 1e-8) << "column " << k;
    }
  }
}

TEST(Lie, MotionOnACircle) {
  // A body that drives 2 m while it turns left by a quarter ends beside the centre of its circle.
  Vector6d twist;
  twist << 2.0, 0.0, 0.0, 0.0, 0.0, 0.5 * M_PI;
  const double radius = 2.0 / (0.5 * M_PI);
  EXPECT_TRUE(expMotion(twist).isApprox(planar(radius, radius, 0.5 * M_PI), 1e-12));
  EXPECT_TRUE(logMotion(planar(radius, radius, 0.5 * M_PI)).isApprox(twist, 1e-12));
}

TEST(Lie, LogarithmInvertsTheExponentialForSmallAndLargeTurns) {
  for (const double angle : {0.0, 1e-6, 0.5, 3.0}) {
    Eigen::Isometry3d motion = planar(0.3, -0.2, angle);
    const Vector6d twist = logMotion(motion);
    // Many small steps of the same velocity make the motion again.
    constexpr int kSteps = 200000;
    const double dt = 1.0 / kSteps;
    double x = 0.0, y = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double yaw = twist[5] * (i + 0.5) * dt;
      x += (twist[0] * std::cos(yaw) - twist[1] * std::sin(yaw)) * dt;
      y += (twist[0] * std::sin(yaw) + twist[1] * std::cos(yaw)) * dt;
    }
    EXPECT_NEAR(twist[5], angle, 1e-9);
    EXPECT_NEAR(x, 0.3, 1e-6) << angle;
    EXPECT_NEAR(y, -0.2, 1e-6) << angle;
    EXPECT_TRUE(expMotion(twist).isApprox(motion, 1e-9)) << angle;
  }
}

TEST(Lie, AdjointCarriesASmallMotionOver) {
  const Eigen::Isometry3d T = expMotion(10.0 * someTwist());
  const Vector6d d = someTwist();
  EXPECT_TRUE((T * expMotion(d)).isApprox(expMotion(adjoint(T) * d) * T, 1e-9));
  EXPECT_TRUE(adjoint(T.inverse()).isApprox(adjoint(T).inverse(), 1e-9));
}

TEST(Lie, InverseLeftJacobianMatchesNumericDifferences) {
  const Eigen::Isometry3d T = expMotion(someTwist());
  const Matrix6d analytic = inverseLeftJacobian(someTwist());
  for (int k = 0; k < 6; ++k) {
    const Vector6d e = kStep * Vector6d::Unit(k);
    const Vector6d numeric = (logMotion(expMotion(e) * T) - logMotion(expMotion(-e) * T)) / (2.0 * kStep);
    EXPECT_LT((numeric - analytic.col(k)).norm(), 1e-6) << "column " << k;
  }
}

TEST(Lie, RenormalisedIsARotationAgain) {
  Eigen::Isometry3d T = planar(1.0, 2.0, 0.3);
  T.linear()(0, 1) += 1e-7;  // as rounding leaves it after very many products
  const Eigen::Matrix3d R = renormalised(T).linear();
  EXPECT_TRUE((R.transpose() * R).isIdentity(1e-14));
  EXPECT_TRUE(renormalised(T).isApprox(planar(1.0, 2.0, 0.3), 1e-7));
}

}  // namespace
}  // namespace stereo_nav
