#include <gtest/gtest.h>

#include "stereo_nav/core/lie.h"
#include "support/textured_room.h"
#include "vision/reprojection.h"
#include "vision/stereo_view.h"

namespace stereo_nav::odometry {
namespace {

Vector6d someTwist() {
  Vector6d twist;
  twist << 0.1, -0.05, 0.3, 0.02, -0.04, 0.03;
  return twist;
}

TEST(LieTest, LogUndoesExp) {
  EXPECT_TRUE(logMotion(expMotion(someTwist())).isApprox(someTwist(), 1e-9));
  EXPECT_TRUE(logMotion(expMotion(Vector6d::Zero())).isZero(1e-12));
  const Eigen::Vector3d nearly_half_turn(0.0, 3.0, 0.5);
  EXPECT_TRUE(logRotation(expRotation(nearly_half_turn)).isApprox(nearly_half_turn, 1e-9));
}

TEST(LieTest, InverseLeftJacobianMatchesNumericDifferences) {
  const Eigen::Isometry3d T = expMotion(someTwist());
  const Matrix6d analytic = inverseLeftJacobian(someTwist());
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const Vector6d e = kStep * Vector6d::Unit(k);
    const Vector6d numeric = (logMotion(expMotion(e) * T) - logMotion(expMotion(-e) * T)) / (2.0 * kStep);
    EXPECT_LT((numeric - analytic.col(k)).norm(), 1e-4) << "column " << k;
  }
}

TEST(StereoViewTest, JacobiansMatchNumericDifferences) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  vision::StereoView view;
  view.T_camera_world = expMotion(someTwist());
  view.T_late_camera = expMotion(-0.3 * someTwist());
  const Eigen::Vector3d p_world(0.5, -0.3, 3.0);
  vision::StereoObservation seen;
  seen.left_px = {100.0, 80.0};
  seen.right_px = {90.0, 81.0};
  seen.has_right = true;
  vision::ViewResidual at;
  ASSERT_TRUE(vision::viewResidual(calibration, view, p_world, seen, at));
  constexpr double kStep = 1e-6;
  const auto errorAt = [&](const Vector6d& pose, const Vector6d& late, const Eigen::Vector3d& camera_point) {
    vision::StereoView moved;
    moved.T_camera_world = expMotion(pose) * view.T_camera_world;
    moved.T_late_camera = expMotion(late) * view.T_late_camera;
    // A shift in the camera frame is one of the world, turned.
    const Eigen::Vector3d p = p_world + view.T_camera_world.linear().transpose() * camera_point;
    vision::ViewResidual residual;
    EXPECT_TRUE(vision::viewResidual(calibration, moved, p, seen, residual));
    return residual.error_px;
  };
  const Vector6d none = Vector6d::Zero();
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  for (int k = 0; k < 6; ++k) {
    const Vector6d e = kStep * Vector6d::Unit(k);
    const Eigen::Vector4d by_pose = (errorAt(e, none, still) - errorAt(-e, none, still)) / (2.0 * kStep);
    EXPECT_LT((by_pose - at.by_pose.col(k)).norm(), 1e-3) << "pose " << k;
    const Eigen::Vector4d by_late = (errorAt(none, e, still) - errorAt(none, -e, still)) / (2.0 * kStep);
    EXPECT_LT((by_late.tail<2>() - at.by_late.col(k)).norm(), 1e-3) << "late " << k;
    EXPECT_LT(by_late.head<2>().norm(), 1e-9) << "the left image knows nothing of the right stamp";
  }
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d e = kStep * Eigen::Vector3d::Unit(k);
    const Eigen::Vector4d by_point = (errorAt(none, none, e) - errorAt(none, none, -e)) / (2.0 * kStep);
    EXPECT_LT((by_point - at.by_camera_point.col(k)).norm(), 1e-3) << "point " << k;
  }
}

TEST(StereoViewTest, TriangulatesAcrossTheMotionBetweenTheStamps) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  const Eigen::Isometry3d T_late_camera = expMotion(0.2 * someTwist());
  const Eigen::Vector3d p(0.4, 0.2, 2.5);
  const Eigen::Vector2d left_px = vision::projectLeft(calibration, p);
  const Eigen::Vector2d right_px = vision::projectRight(calibration, T_late_camera * p);
  const vision::Triangulation depth = vision::triangulate(calibration, T_late_camera, left_px, right_px);
  EXPECT_NEAR(depth.inverse_depth, 1.0 / 2.5, 1e-9);
  EXPECT_NEAR(depth.epipolar_px, 0.0, 1e-6);
  EXPECT_TRUE(
      vision::transferToRight(calibration, T_late_camera, left_px, 1.0 / 2.5).isApprox(right_px, 1e-9));
}

TEST(StereoViewTest, ASynchronousPairIsThePlainDisparity) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  const vision::Triangulation depth =
      vision::triangulate(calibration, Eigen::Isometry3d::Identity(), {200.0, 100.0}, {190.0, 100.0});
  const double disparity_px = 10.0 + calibration.right_cx - calibration.cx;
  EXPECT_NEAR(depth.inverse_depth, disparity_px / (calibration.fx * calibration.baseline_m), 1e-9);
  const vision::Triangulation behind =
      vision::triangulate(calibration, Eigen::Isometry3d::Identity(), {190.0, 100.0}, {240.0, 100.0});
  EXPECT_LT(behind.inverse_depth, 0.0);
}

}  // namespace
}  // namespace stereo_nav::odometry
