#include "mapping/map/visual_map.h"

#include <algorithm>
#include <cstring>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {
namespace {

/// Inverse covariance, with rotations as vector parts of quaternions: halves of the angles.
Matrix6d informationOf(const Matrix6d& covariance) {
  Matrix6d information = covariance.inverse();
  information.bottomRows<3>() *= 2.0;
  information.rightCols<3>() *= 2.0;
  return 0.5 * (information + information.transpose());
}

std::size_t indexOf(const VisualMap& map, std::uint32_t id) {
  if (const auto index = indexOfKeyframe(map, id)) return *index;
  throw InputError("the map has a loop with keyframe " + std::to_string(id) + ", which it does not have");
}

}  // namespace

std::optional<std::size_t> indexOfKeyframe(const VisualMap& map, std::uint32_t id) {
  const auto found = std::lower_bound(
      map.keyframes.begin(), map.keyframes.end(), id,
      [](const MapKeyframe& keyframe, std::uint32_t wanted) { return keyframe.keyframe.id < wanted; });
  if (found == map.keyframes.end() || found->keyframe.id != id) return std::nullopt;
  return static_cast<std::size_t>(found - map.keyframes.begin());
}

std::uint64_t calibrationHash(const vision::StereoCalibration& calibration) {
  const double numbers[] = {calibration.fx,
                            calibration.fy,
                            calibration.cx,
                            calibration.cy,
                            calibration.right_cx,
                            calibration.baseline_m,
                            static_cast<double>(calibration.width),
                            static_cast<double>(calibration.height)};
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const double number : numbers) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ ((bits >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
  }
  return hash;
}

void requireCalibration(const VisualMap& map, const vision::StereoCalibration& calibration) {
  if (map.calibration_hash != calibrationHash(calibration))
    throw InputError(
        "the map was made with other cameras or before they were calibrated anew: its depths and descriptors do not fit; use the calibration of that time, or make the map anew");
}

SpatialGraph graphOf(const VisualMap& map) {
  SpatialGraph graph;
  for (const MapKeyframe& keyframe : map.keyframes) {
    graph.ids.push_back(keyframe.keyframe.id);
    graph.poses.push_back(keyframe.T_map_camera);
  }
  for (std::size_t k = 1; k < map.keyframes.size(); ++k) {
    const vision::Keyframe& keyframe = map.keyframes[k].keyframe;
    if (keyframe.follows)
      graph.edges.push_back({k - 1, k, keyframe.T_previous_keyframe, informationOf(keyframe.covariance)});
  }
  for (const MapLoop& loop : map.loops)
    graph.edges.push_back({indexOf(map, loop.from_id), indexOf(map, loop.to_id), loop.T_from_to,
                           informationOf(loop.covariance)});
  return graph;
}

}  // namespace stereo_nav::mapping
