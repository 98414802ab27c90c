#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "mapping/mono/mono_camera.h"
#include "mapping/mono/mono_motion.h"
#include "mapping/mono/mono_state.h"

namespace stereo_nav::mapping::test {

/// 320 x 240, 60 degrees of view.
inline MonoCamera smallCamera() {
  return {277.0, 277.0, 159.5, 119.5, 0.0, {320, 240}};
}

/// MonoSLAM's (SceneLib).
inline MonoCamera wideCamera() {
  return {195.0, 195.0, 162.0, 125.0, 9e-6, {320, 240}};
}

/// Points before the camera, 2 to 6 m away.
inline std::vector<Eigen::Vector3d> pointsBefore(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> across(-1.0, 1.0), depth_m(2.0, 6.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = across(random), y = across(random), z = depth_m(random);
    points.push_back(z * Eigen::Vector3d(x, 0.8 * y, 1.0));
  }
  return points;
}

inline Eigen::Vector3d noiseVector(double sigma, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, sigma);
  const double x = normal(random), y = normal(random);
  return {x, y, normal(random)};
}

/// The next state of a camera whose rates change as the filter expects.
inline CameraState strayed(const CameraState& camera, double duration_s, const MotionNoise& noise,
                           std::mt19937& random) {
  constexpr int kSteps = 5;
  CameraState next = camera;
  for (int i = 0; i < kSteps; ++i) {
    const double step_s = duration_s / kSteps;
    next = movedCamera(next, step_s);
    next.v_world += noiseVector(noise.acceleration_sigma * std::sqrt(step_s), random);
    next.omega_camera += noiseVector(noise.turn_acceleration_sigma * std::sqrt(step_s), random);
  }
  return next;
}

}  // namespace stereo_nav::mapping::test
