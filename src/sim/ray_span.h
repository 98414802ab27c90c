#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "sim/scene.h"

namespace stereo_nav::sim {

/// A row of neighbouring rays through one camera pose, cast together so that the compiler can vectorise.
struct RaySpan {
  static constexpr int kLength = 16;
  const float* x;  ///< kLength rays (x, y, 1) in the camera frame
  const float* y;
  std::array<float, kLength> depth;  ///< of the nearest hit so far, camera z
  std::array<int, kLength> hit;      ///< index of the candidate that was hit, -1 for none
};

/// A solid as seen from one camera pose; transforms rays of the camera into the solid's frame.
struct Candidate {
  const Solid* solid;
  Eigen::Matrix3f R_solid_camera;
  Eigen::Vector3f p_camera;  ///< camera centre in the solid's frame
};

Candidate makeCandidate(const Solid& solid, const Eigen::Isometry3d& T_world_camera, double time_s);

/// Largest depth of the span, infinite while a ray has hit nothing.
float farthestDepth(const RaySpan& span);

/// Stores the hits with `candidate` that are nearer than those in `span`.
void castSpan(const Candidate& candidate, int index, RaySpan& span);

/// How finely the texture around a ray's hit must be sampled.
struct Footprint {
  float ray_pitch;   ///< distance of neighbouring pixels' rays
  float level_bias;  ///< in [0, 1): fractional pyramid levels are rounded up in this share of the samples
};

/// Adds `weight` times the light that comes back along the first `count` rays of the span to `out`.
void shadeSpan(const std::vector<Candidate>& candidates, const RaySpan& span, int count,
               const Footprint& footprint, float weight, float* out);

}  // namespace stereo_nav::sim
