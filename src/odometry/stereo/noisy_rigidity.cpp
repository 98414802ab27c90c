#include "odometry/stereo/noisy_rigidity.h"

#include <cmath>

namespace stereo_nav::odometry {
namespace {

/// Covariance lateral^2 I + along^2 r r^T of a triangulated point, r its unit ray.
struct NoisyPoint {
  Eigen::Vector3d p;
  Eigen::Vector3d scaled_ray;  ///< along * r
  double lateral_squared;
};

NoisyPoint withNoise(const NoisyRigidityParams& params, const vision::StereoCalibration& calibration,
                     const Eigen::Vector3d& p) {
  const double z = p.z();
  const double lateral_m = params.pixel_sigma_px * z / calibration.fx;
  const double along_m = params.disparity_sigma_px * z * z / (calibration.fx * calibration.baseline_m);
  return {p, p * (along_m / z), lateral_m * lateral_m};
}

/// Distance of two points and its variance, along the line between them.
struct NoisyDistance {
  double metres;
  double variance;
};

NoisyDistance distance(const NoisyPoint& a, const NoisyPoint& b) {
  const Eigen::Vector3d line = a.p - b.p;
  const double squared = line.squaredNorm();
  const double along_a = line.dot(a.scaled_ray);
  const double along_b = line.dot(b.scaled_ray);
  const double along = squared > 0.0 ? (along_a * along_a + along_b * along_b) / squared : 0.0;
  return {std::sqrt(squared), along + a.lateral_squared + b.lateral_squared};
}

}  // namespace

void NoisyRigidityParams::describe(ParameterVisitor& visitor) {
  visitor.real("disparity_sigma_px", disparity_sigma_px, {0.01, 10.0}, "px", "noise of a disparity");
  visitor.real("pixel_sigma_px", pixel_sigma_px, {0.01, 10.0}, "px", "noise of a tracked position");
  visitor.real("gate_sigmas", gate_sigmas, {0.1, 100.0}, "",
               "largest change of a distance that still counts as rigid, in its own sigmas");
}

ConsistencyGraph buildNoisyRigidityGraph(const NoisyRigidityParams& params,
                                         const vision::StereoCalibration& calibration,
                                         const std::vector<RigidPoint>& points) {
  std::vector<NoisyPoint> before;
  std::vector<NoisyPoint> now;
  for (const RigidPoint& point : points) {
    before.push_back(withNoise(params, calibration, point.before));
    now.push_back(withNoise(params, calibration, point.now));
  }
  const double gate = params.gate_sigmas * params.gate_sigmas;
  ConsistencyGraph graph(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const NoisyDistance then = distance(before[i], before[j]);
      const NoisyDistance today = distance(now[i], now[j]);
      const double change = today.metres - then.metres;
      if (change * change <= gate * (then.variance + today.variance)) graph.connect(i, j);
    }
  }
  return graph;
}

}  // namespace stereo_nav::odometry
