// The pose of a checkerboard 1 m in front of a perfectly rectified pair.
#include <stereo_nav/calibration/calibration_check.h>

#include "expect.h"

int main() {
  stereo_nav::vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = 400.0;
  calibration.cx = calibration.right_cx = 160.0;
  calibration.cy = 120.0;
  calibration.baseline_m = 0.1;
  calibration.width = 320;
  calibration.height = 240;

  const stereo_nav::calibration::Checkerboard board;
  std::vector<Eigen::Vector2d> left_px, right_px;
  for (const Eigen::Vector3d& corner : board.corners()) {
    const Eigen::Vector3d seen = calibration.project(corner + Eigen::Vector3d(0.0, 0.0, 1.0));
    left_px.emplace_back(seen.x(), seen.y());
    right_px.emplace_back(seen.z(), seen.y());
  }
  const auto pose = stereo_nav::calibration::estimateBoardPose(calibration, board, left_px, right_px);
  expect(pose.has_value(), "the board has a pose");
  expect((pose->T_camera_board.translation() - Eigen::Vector3d(0.0, 0.0, 1.0)).norm() < 1e-6,
         "it is 1 m ahead");
}
