#include "mapping/mono/known_start.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "point_world.h"
#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav::mapping {
namespace {

/// MonoSLAM's four patches, before a camera at `T_world_camera`.
std::vector<KnownPoint> patches(const Eigen::Isometry3d& T_world_camera) {
  CameraState state;
  state.p_world = T_world_camera.translation();
  state.q_world_camera = Eigen::Quaterniond(T_world_camera.linear());
  std::vector<KnownPoint> points;
  for (const double x_m : {-0.105, 0.105}) {
    for (const double y_m : {-0.07425, 0.07425}) {
      StateBlock block;
      block.value.head<3>() << x_m, y_m, 0.0;
      points.push_back({block.value.head<3>(), *pixelOf(test::wideCamera(), state, block, 0.0)});
    }
  }
  return points;
}

Eigen::Isometry3d someView() {
  Eigen::Isometry3d T = pose(0.05, -0.03, -0.6);
  T.linear() = expRotation({0.1, 0.2, -0.05});
  return T;
}

TEST(KnownStart, FourPointsGiveThePose) {
  const PoseWithCovariance start = knownStart(test::wideCamera(), patches(someView()), 0.5);
  EXPECT_LT((start.T_world_camera.matrix() - someView().matrix()).norm(), 1e-7);
}

TEST(KnownStart, ThePoseIsAsWrongAsItsCovarianceSays) {
  std::mt19937 random(4);
  double sum = 0.0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<KnownPoint> points = patches(someView());
    for (KnownPoint& point : points) point.px += test::noiseVector(0.2, random).head<2>();
    const PoseWithCovariance start = knownStart(test::wideCamera(), points, 0.2);
    Vector6d error;
    error << someView().translation() - start.T_world_camera.translation(),
        logRotation(Eigen::Matrix3d(start.T_world_camera.linear().transpose() * someView().linear()));
    sum += error.dot(start.covariance.ldlt().solve(error));
  }
  EXPECT_GT(sum / (6.0 * kRuns), 0.7);
  EXPECT_LT(sum / (6.0 * kRuns), 1.4);
}

TEST(KnownStart, WhatGivesNoPoseIsNamed) {
  std::vector<KnownPoint> three = patches(someView());
  three.pop_back();
  EXPECT_NE(messageOf<InputError>([&] { knownStart(test::wideCamera(), three, 0.5); }).find("3 known points"),
            std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::mapping
