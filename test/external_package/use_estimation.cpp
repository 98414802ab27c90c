// The pose of the base from the motion of a camera that is mounted 0.5 m ahead of it.
#include <stereo_nav/estimation/base_odometry.h>

#include "expect.h"

int main() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.translation().x() = 0.5;
  stereo_nav::estimation::BaseOdometry base({}, T_base_camera);

  stereo_nav::odometry::FrameResult result;
  result.state = stereo_nav::odometry::State::kTracking;
  base.update(result, 0.0);
  result.T_start_camera.translation().x() = 0.2;
  result.T_previous_current = result.T_start_camera;
  const stereo_nav::estimation::BaseEstimate& estimate = base.update(result, 0.1);
  expect(std::abs(estimate.T_odom_base.translation().x() - 0.2) < 1e-12,
         "the base has moved with the camera");
  expect(std::abs(estimate.twist(0) - 2.0) < 1e-12, "it drives at 2 m/s");
  expect(estimate.pose_covariance(0, 0) > 0.0, "the pose has a covariance");
}
