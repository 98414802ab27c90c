#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/point_alignment.h"

namespace stereo_nav::mapping {

/// A point of the map and where it is in the world, m.
struct WorldPair {
  Eigen::Vector3d p_map, p_world;
};

/// Where the map lies in the world: p_world = similarity * p_map.
struct WorldTransform {
  Similarity T_world_map;
  SimilarityFreedom freedom;        ///< what the pairs were allowed to determine
  std::vector<double> residuals_m;  ///< of the pairs, in their order
  double rms_m = 0.0;               ///< of the residuals
};

/// The transform with the least sum of squared residuals (core/point_alignment.h). With `planar` the map
/// stays level: the related work's translation, uniform scale and rotation in the plane. Throws InputError
/// for fewer than three pairs, numbers that are not finite, and points on a line, about which the map could
/// turn - with `planar`, points of which all stand above one another.
WorldTransform alignWithWorld(const std::vector<WorldPair>& pairs, const SimilarityFreedom& freedom);

/// Reads pairs from a text file: x y z in the map, x y z in the world, m, one pair a line, `#` begins a
/// comment. Throws InputError with `file:line:`.
std::vector<WorldPair> readWorldPairs(const std::string& path);

}  // namespace stereo_nav::mapping
