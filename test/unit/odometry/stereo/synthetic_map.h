#pragma once

#include <random>
#include <vector>

#include "vision/stereo_view.h"

namespace stereo_nav::test {

/// Points in front of the camera at the origin, 1.5 to 8 m away, all well inside the image.
inline std::vector<Eigen::Vector3d> pointsAhead(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-0.25, 0.25);
  std::uniform_real_distribution<double> depth(1.5, 8.0);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = depth(random);
    points.emplace_back(side(random) * z, side(random) * z, z);
  }
  return points;
}

/// What a frame sees of a point, with Gaussian noise.
inline vision::StereoObservation observe(const vision::StereoCalibration& calibration,
                                         const vision::StereoView& view, const Eigen::Vector3d& p_world,
                                         double sigma_px, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  const Eigen::Vector3d p_camera = view.T_camera_world * p_world;
  vision::StereoObservation seen;
  seen.left_px = vision::projectLeft(calibration, p_camera);
  seen.right_px = vision::projectRight(calibration, view.T_late_camera * p_camera);
  for (int k = 0; k < 2; ++k) {
    seen.left_px[k] += sigma_px * noise(random);
    seen.right_px[k] += sigma_px * noise(random);
  }
  seen.has_right = true;
  return seen;
}

}  // namespace stereo_nav::test
