#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <random>

#include "core/optical_axes.h"
#include "navigation/obstacles/floor_plane.h"

namespace stereo_nav::navigation {

/// A camera like the thesis' one, 0.28 m above the floor, `pitch_rad` down.
inline DisparityCamera drawnCamera(double pitch_rad = 0.0) {
  DisparityCamera camera;
  camera.fx = camera.fy = 460.0;
  camera.cx = 160.0;
  camera.cy = 120.0;
  camera.baseline_m = 0.12;
  camera.T_base_camera.linear() =
      Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() * opticalToBody();
  camera.T_base_camera.translation() = Eigen::Vector3d(0.1, 0.06, 0.28);
  return camera;
}

/// The disparity of what a function shows, with noise: `depth(origin, direction)` gets a ray in base_link and
/// returns where it ends, in lengths of `direction`; infinite for nothing.
inline cv::Mat drawDisparity(
    const DisparityCamera& camera, double sigma_px, unsigned seed,
    const std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>& depth) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 1.0);  // of no width it would not be defined
  cv::Mat_<float> disparity(240, 320, -1.0F);
  for (int v = 0; v < disparity.rows; ++v) {
    for (int u = 0; u < disparity.cols; ++u) {
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0);
      const double z_m = depth(camera.T_base_camera.translation(), camera.T_base_camera.linear() * ray);
      const double d = camera.fx * camera.baseline_m / z_m;
      if (std::isfinite(z_m) && d < 64.0)
        disparity(v, u) = static_cast<float>(d + sigma_px * noise(generator));
    }
  }
  return disparity;
}

/// Where a ray meets the plane z = height_m.
inline double planeAt(double height_m, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const double z_m = (height_m - origin.z()) / direction.z();
  return z_m > 0.0 ? z_m : INFINITY;
}

}  // namespace stereo_nav::navigation
