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

/// Points all around, 1 to 5 m away from the origin.
inline std::vector<Eigen::Vector3d> pointsAround(int count, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(1.0, 5.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d direction(normal(random), normal(random), normal(random));
    points.push_back(distance(random) * direction.normalized());
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
