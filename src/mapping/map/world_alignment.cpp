#include "mapping/map/world_alignment.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {
namespace {

/// Points whose second largest spread is below this share of the largest are on a line.
constexpr double kLineShare = 1e-3;

/// Standard deviations of points along their principal axes, in increasing order.
Eigen::Vector3d spreads(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& point : points)
    covariance += (point - mean) * (point - mean).transpose() / static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  return axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

void requireShape(const char* where, std::vector<Eigen::Vector3d> points, bool planar) {
  for (auto& point : points) {
    if (!point.allFinite())
      throw InputError(fmt::format("a point in the {} has coordinates that are no finite numbers", where));
    if (planar) point.z() = 0.0;
  }
  const Eigen::Vector3d spread = spreads(points);
  if (planar ? spread[2] < 1e-6 : spread[1] <= kLineShare * spread[2])
    throw InputError(fmt::format(
        "the points in the {} are {}: the rotation is open; choose points further {}", where,
        planar ? "all at one place, seen from above" : "on a line, about which the map could turn",
        planar ? "apart" : "to the side of each other"));
}

}  // namespace

WorldTransform alignWithWorld(const std::vector<WorldPair>& pairs, const SimilarityFreedom& freedom) {
  if (pairs.size() < 3)
    throw InputError(fmt::format("{} pairs of points in map and world: at least 3 are needed", pairs.size()));
  std::vector<Eigen::Vector3d> map_m, world_m;
  for (const auto& pair : pairs) {
    map_m.push_back(pair.p_map);
    world_m.push_back(pair.p_world);
  }
  requireShape("map", map_m, freedom.planar);
  requireShape("world", world_m, freedom.planar);
  WorldTransform world;
  world.freedom = freedom;
  world.T_world_map = alignSimilarly(map_m, world_m, freedom);
  double sum = 0.0;
  for (const auto& pair : pairs) {
    world.residuals_m.push_back((world.T_world_map * pair.p_map - pair.p_world).norm());
    sum += world.residuals_m.back() * world.residuals_m.back();
  }
  world.rms_m = std::sqrt(sum / static_cast<double>(pairs.size()));
  return world;
}

std::vector<WorldPair> readWorldPairs(const std::string& path) {
  std::vector<WorldPair> pairs;
  for (const TextRow& row : readTextTable(path)) {
    if (row.fields.size() != 6)
      throw InputError(fmt::format("{}: {} numbers, 6 are needed: x y z in the map and x y z in the world, m",
                                   row.source, row.fields.size()));
    pairs.push_back(
        {{row.number(0), row.number(1), row.number(2)}, {row.number(3), row.number(4), row.number(5)}});
  }
  return pairs;
}

}  // namespace stereo_nav::mapping
