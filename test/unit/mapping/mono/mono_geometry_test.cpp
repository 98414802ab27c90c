#include <gtest/gtest.h>

#include "mapping/mono/inverse_depth.h"
#include "mapping/mono/mono_landmarks.h"
#include "mapping/mono/pixel_prediction.h"
#include "point_world.h"

namespace stereo_nav::mapping {
namespace {

constexpr double kStep = 1e-6;

CameraState someCamera() {
  CameraState camera;
  camera.p_world = {0.3, -0.2, 0.1};
  camera.q_world_camera = expQuaternion({0.1, -0.3, 0.2});
  camera.v_world = {0.4, 0.1, -0.3};
  camera.omega_camera = {0.5, -0.7, 0.3};
  return camera;
}

CameraState disturbed(const CameraState& camera, Eigen::Index row, double by) {
  MonoState state(kCameraRows);
  state.camera = camera;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(kCameraRows);
  step(row) = by;
  state.correct(step);
  return state.camera;
}

Eigen::Matrix<double, kCameraRows, 1> difference(const CameraState& a, const CameraState& b) {
  Eigen::Matrix<double, kCameraRows, 1> error;
  error << a.p_world - b.p_world, logRotation(b.q_world_camera.conjugate() * a.q_world_camera),
      a.v_world - b.v_world, a.omega_camera - b.omega_camera;
  return error;
}

StateBlock someLandmark(StateBlock::Form form) {
  StateBlock landmark;
  landmark.form = form;
  if (form == StateBlock::Form::kInverseDepth) {
    landmark.value << 0.1, 0.2, -0.1, -0.1, 0.05, 0.4;
  } else {
    landmark.value.head<3>() << 0.2, 0.3, 2.5;
  }
  return landmark;
}

void expectJacobiansRight(const MonoCamera& camera, StateBlock::Form form, double readout_s) {
  const CameraState state = someCamera();
  const StateBlock landmark = someLandmark(form);
  const auto expected = expectedPixel(camera, state, landmark, readout_s);
  ASSERT_TRUE(expected);
  EXPECT_LT((*pixelOf(camera, state, landmark, readout_s) - expected->px).norm(), 1e-9);
  for (Eigen::Index row = 0; row < kCameraRows; ++row) {
    const Eigen::Vector2d slope = (*pixelOf(camera, disturbed(state, row, kStep), landmark, readout_s) -
                                   *pixelOf(camera, disturbed(state, row, -kStep), landmark, readout_s)) /
                                  (2.0 * kStep);
    // A row's time depends on the pixel itself, which the filter neglects: a part of the readout in 1 s.
    EXPECT_LT((slope - expected->by_camera.col(row)).norm(), 1e-3 + 0.05 * slope.norm() * (readout_s > 0.0))
        << row;
  }
  for (Eigen::Index row = 0; row < landmark.rows(); ++row) {
    StateBlock after = landmark, before = landmark;
    after.value(row) += kStep;
    before.value(row) -= kStep;
    const Eigen::Vector2d slope =
        (*pixelOf(camera, state, after, readout_s) - *pixelOf(camera, state, before, readout_s)) /
        (2.0 * kStep);
    EXPECT_LT((slope - expected->by_landmark.col(row)).norm(), 1e-3 + 0.05 * slope.norm() * (readout_s > 0.0))
        << row;
  }
}

TEST(MonoGeometry, TheRayHasTheAxesOfAnOpticalFrame) {
  EXPECT_LT((inverseDepthRay(0.0, 0.0) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_GT(inverseDepthRay(0.1, 0.0).x(), 0.0);  // to the right
  EXPECT_LT(inverseDepthRay(0.0, 0.1).y(), 0.0);  // upwards
  const Eigen::Vector3d direction(0.3, -0.4, 2.0);
  const Eigen::Vector2d angles = anglesOf(direction);
  EXPECT_LT((inverseDepthRay(angles.x(), angles.y()) - direction.normalized()).norm(), 1e-12);
}

TEST(MonoGeometry, DerivativesOfRaysAreThoseOfDifferences) {
  const Eigen::Vector3d direction(0.3, -0.4, 2.0);
  const Eigen::Matrix<double, 2, 3> by_direction = anglesByDirection(direction);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    EXPECT_LT(
        ((anglesOf(direction + step) - anglesOf(direction - step)) / (2.0 * kStep) - by_direction.col(axis))
            .norm(),
        1e-7);
  }
  const Vector6d landmark = someLandmark(StateBlock::Form::kInverseDepth).value;
  for (int row = 0; row < 6; ++row) {
    const Vector6d step = kStep * Vector6d::Unit(row);
    EXPECT_LT(((pointOf(landmark + step) - pointOf(landmark - step)) / (2.0 * kStep) -
               pointByInverseDepth(landmark).col(row))
                  .norm(),
              1e-6);
  }
}

TEST(MonoGeometry, ARayLeadsBackToItsPixel) {
  for (const MonoCamera& camera : {test::smallCamera(), test::wideCamera()}) {
    for (const Eigen::Vector2d& px :
         {Eigen::Vector2d(5.0, 7.0), Eigen::Vector2d(162.0, 125.0), Eigen::Vector2d(300.0, 30.0)}) {
      EXPECT_LT((camera.project(3.0 * camera.ray(px))->px - px).norm(), 1e-9);
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d step = 1e-4 * Eigen::Vector2d::Unit(axis);
        const Eigen::Vector3d slope = (camera.ray(px + step) - camera.ray(px - step)) / 2e-4;
        EXPECT_LT((slope.head<2>() - camera.rayByPixel(px).col(axis)).norm(), 1e-7);
      }
    }
  }
}

TEST(MonoGeometry, TheWideAngleLensIsThatOfSceneLib) {
  // A ray 45 degrees to the right: 195 px of a pinhole, 195 / sqrt(1 + 2 * 9e-6 * 195^2) px of this lens.
  const auto seen = test::wideCamera().project({1.0, 0.0, 1.0});
  EXPECT_NEAR(seen->px.x(), 162.0 + 195.0 / std::sqrt(1.0 + 2.0 * 9e-6 * 195.0 * 195.0), 1e-9);
  EXPECT_NEAR(seen->px.y(), 125.0, 1e-9);
}

TEST(MonoGeometry, DerivativesOfAPixelAreThoseOfDifferences) {
  for (const MonoCamera& camera : {test::smallCamera(), test::wideCamera()}) {
    for (const auto form : {StateBlock::Form::kInverseDepth, StateBlock::Form::kPoint}) {
      expectJacobiansRight(camera, form, 0.0);
      expectJacobiansRight(camera, form, 0.03);
    }
  }
}

TEST(MonoGeometry, DerivativesOfTheMotionAreThoseOfDifferences) {
  const CameraState camera = someCamera();
  Matrix12d transition;
  const CameraState moved = movedCamera(camera, 0.1, &transition);
  EXPECT_LT((moved.p_world - Eigen::Vector3d(0.34, -0.19, 0.07)).norm(), 1e-12);
  for (Eigen::Index row = 0; row < kCameraRows; ++row) {
    const Eigen::Matrix<double, kCameraRows, 1> slope =
        (difference(movedCamera(disturbed(camera, row, kStep), 0.1), moved) -
         difference(movedCamera(disturbed(camera, row, -kStep), 0.1), moved)) /
        (2.0 * kStep);
    EXPECT_LT((slope - transition.col(row)).norm(), 1e-6) << row;
  }
}

TEST(MonoGeometry, ANewLandmarkIsAsUncertainAsItsCameraAndPixel) {
  const MonoCamera camera = test::wideCamera();
  const Eigen::Vector2d px(220.0, 80.0);
  MonoState state(100);
  state.camera = someCamera();
  Matrix12d P = 1e-4 * Matrix12d::Identity();
  P(0, 4) = P(4, 0) = 5e-5;
  state.covariance.start(P);
  const StateBlock landmark = addInverseDepth(state, camera, px, 0.5, {0.4, 0.2}, 0.03);
  EXPECT_LT((*pixelOf(camera, state.camera, landmark, 0.0) - px).norm(), 10.0);
  EXPECT_LT((*pixelOf(camera, state.camera, landmark, 0.03) - px).norm(), 0.1);
  const auto valueFrom = [&](const CameraState& from, const Eigen::Vector2d& at) {
    MonoState other(100);
    other.camera = from;
    other.covariance.start(P);
    return addInverseDepth(other, camera, at, 0.5, {0.4, 0.2}, 0.03).value;
  };
  Eigen::Matrix<double, 6, kCameraRows> J;
  for (Eigen::Index row = 0; row < kCameraRows; ++row)
    J.col(row) = (valueFrom(disturbed(state.camera, row, kStep), px) -
                  valueFrom(disturbed(state.camera, row, -kStep), px)) /
                 (2.0 * kStep);
  Eigen::Matrix<double, 6, 2> by_px;
  for (int axis = 0; axis < 2;
       ++axis)  // along the row alone: the time of the row is not taken to be uncertain
    by_px.col(axis) = (valueFrom(state.camera, px + 1e-4 * Eigen::Vector2d::Unit(axis)) -
                       valueFrom(state.camera, px - 1e-4 * Eigen::Vector2d::Unit(axis))) /
                      2e-4;
  Matrix6d expected = J * P * J.transpose();
  expected(5, 5) += 0.04;
  expected.block<2, 2>(3, 3) += 0.25 * (by_px * by_px.transpose()).block<2, 2>(3, 3);
  EXPECT_LT((state.covariance.matrix().bottomRightCorner<6, 6>() - expected).norm(), 1e-6);
  EXPECT_LT((state.covariance.matrix().bottomLeftCorner<6, 12>() - J * P).norm(), 1e-9);
}

TEST(MonoGeometry, ALandmarkOfCertainDepthBecomesAPointWithTheSameCovariance) {
  MonoState state(100);
  state.covariance.start(1e-6 * Matrix12d::Identity());
  addInverseDepth(state, test::smallCamera(), {100.0, 90.0}, 0.5, {0.5, 0.4}, 0.0);
  addInverseDepth(state, test::smallCamera(), {200.0, 90.0}, 0.5, {0.5, 0.01}, 0.0);
  addKnownPoint(state, {1.0, 2.0, 3.0}, 0.1);
  const Vector6d value = state.blocks[1].value;
  const Matrix6d before = state.covariance.matrix().block<6, 6>(18, 18);
  convertToPoints(state, 0.1);
  EXPECT_EQ(state.blocks[0].form, StateBlock::Form::kInverseDepth);
  ASSERT_EQ(state.blocks[1].form, StateBlock::Form::kPoint);
  EXPECT_LT((state.blocks[1].value.head<3>() - pointOf(value)).norm(), 1e-12);
  const auto J = pointByInverseDepth(value);
  EXPECT_LT((state.covariance.matrix().block<3, 3>(18, 18) - J * before * J.transpose()).norm(), 1e-12);
  EXPECT_EQ(state.blocks[2].offset, 21);
  EXPECT_EQ(state.covariance.size(), 24);
  EXPECT_NEAR(state.covariance.matrix()(23, 23), 0.01, 1e-15);
}

}  // namespace
}  // namespace stereo_nav::mapping
