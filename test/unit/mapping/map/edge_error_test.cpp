#include "mapping/map/edge_error.h"

#include <gtest/gtest.h>

namespace stereo_nav::mapping {
namespace {

template <class Pose>
Pose someMotion(int number) {
  typename Motion<Pose>::Vector twist;
  for (int i = 0; i < twist.size(); ++i) twist[i] = 1.3 * std::sin(2.7 * number + 1.9 * i);
  return Motion<Pose>::exp(twist);
}

/// T = (t + dt, R exp(dr)).
Eigen::Isometry2d moved(const Eigen::Isometry2d& T, const Eigen::Vector3d& step) {
  return Eigen::Translation2d(T.translation() + step.head<2>()) *
         Eigen::Rotation2Dd(Eigen::Rotation2Dd(T.linear()) * Eigen::Rotation2Dd(step[2]));
}

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Vector6d& step) {
  return Eigen::Translation3d(T.translation() + step.head<3>()) *
         Eigen::Quaterniond(T.linear() * expRotation(step.tail<3>()));
}

template <class Pose>
class EdgeErrorOf : public ::testing::Test {};
using Poses = ::testing::Types<Eigen::Isometry2d, Eigen::Isometry3d>;
TYPED_TEST_SUITE(EdgeErrorOf, Poses);

TYPED_TEST(EdgeErrorOf, IsZeroWhereTheMeasurementHolds) {
  GraphEdge<TypeParam> edge;
  edge.T_from_to = someMotion<TypeParam>(1);
  const TypeParam from = someMotion<TypeParam>(2);
  EXPECT_LT(edgeError(edge, from, TypeParam(from * edge.T_from_to)).norm(), 1e-12);
}

TYPED_TEST(EdgeErrorOf, HasTheDerivativesThatDifferencesGive) {
  constexpr double kStep = 1e-6;
  for (int number = 0; number < 20; ++number) {
    GraphEdge<TypeParam> edge;
    edge.T_from_to = someMotion<TypeParam>(3 * number);
    const TypeParam from = someMotion<TypeParam>(3 * number + 1), to = someMotion<TypeParam>(3 * number + 2);
    const auto J = edgeJacobians(edge, from, to);
    for (int i = 0; i < Motion<TypeParam>::kDof; ++i) {
      typename Motion<TypeParam>::Vector step = Motion<TypeParam>::Vector::Zero();
      step[i] = kStep;
      const typename Motion<TypeParam>::Vector by_from =
          (edgeError(edge, moved(from, step), to) - edgeError(edge, moved(from, -step), to)) / (2.0 * kStep);
      const typename Motion<TypeParam>::Vector by_to =
          (edgeError(edge, from, moved(to, step)) - edgeError(edge, from, moved(to, -step))) / (2.0 * kStep);
      EXPECT_LT((J.from.col(i) - by_from).norm(), 1e-7) << "edge " << number << ", from, column " << i;
      EXPECT_LT((J.to.col(i) - by_to).norm(), 1e-7) << "edge " << number << ", to, column " << i;
    }
  }
}

TEST(EdgeError, InSpaceIsTheVectorPartOfTheQuaternion) {
  GraphEdge<Eigen::Isometry3d> edge;
  const Eigen::Isometry3d quarter(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  const Vector6d error = edgeError(edge, Eigen::Isometry3d::Identity(), quarter);
  EXPECT_NEAR(error[5], std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace stereo_nav::mapping
