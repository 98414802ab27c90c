// The geometry of a rectified pair: a point projected into both images and found again from its disparity.
#include <stereo_nav/vision/stereo_calibration.h>

#include "expect.h"

int main() {
  stereo_nav::vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = 400.0;
  calibration.cx = calibration.right_cx = 160.0;
  calibration.cy = 120.0;
  calibration.baseline_m = 0.1;
  calibration.width = 320;
  calibration.height = 240;
  calibration.validate();

  const Eigen::Vector3d p_camera(0.2, -0.1, 2.0);
  const Eigen::Vector3d seen = calibration.project(p_camera);
  const Eigen::Vector3d found = calibration.backProject(seen.x(), seen.y(), seen.x() - seen.z());
  expect((found - p_camera).norm() < 1e-9, "the point is found where it is");
}
