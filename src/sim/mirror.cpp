#include "sim/mirror.h"

namespace stereo_nav::sim {

Eigen::Isometry3d Mirror::reflection() const {
  Eigen::Isometry3d flip = Eigen::Isometry3d::Identity();
  flip.linear()(2, 2) = -1.0;
  return T_world_mirror * flip * T_world_mirror.inverse();
}

double Mirror::side(const Eigen::Vector3d& p_world) const {
  return T_world_mirror.linear().col(2).dot(p_world - T_world_mirror.translation());
}

float mirroredShare(float reflectance, float cosine) {
  const float grazing = 1.0f - cosine, grazing2 = grazing * grazing;
  return reflectance + (1.0f - reflectance) * grazing2 * grazing2 * grazing;
}

}  // namespace stereo_nav::sim
