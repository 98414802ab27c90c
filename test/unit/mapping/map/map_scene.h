#pragma once

#include <cmath>

#include "mapping/map/map_file.h"

namespace stereo_nav::mapping {

/// A small map with all that a file can hold: keyframes on a line, one of them after a new start.
inline VisualMap smallMap() {
  VisualMap map;
  map.calibration_hash = 0x123456789abcdef0U;
  for (std::uint32_t k = 0; k < 6; ++k) {
    MapKeyframe in_map;
    vision::Keyframe& keyframe = in_map.keyframe;
    keyframe.id = 10 + 2 * k;
    keyframe.time_s = 1.6e9 + 0.1 * k;
    keyframe.follows = k != 0 && k != 4;
    keyframe.T_previous_keyframe =
        Eigen::Translation3d(0, 0, 0.5) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
    keyframe.covariance = 1e-4 * (Matrix6d::Identity() + 0.1 * Matrix6d::Ones());
    in_map.T_map_camera =
        k == 0 ? Eigen::Isometry3d::Identity()
               : Eigen::Isometry3d(map.keyframes.back().T_map_camera * keyframe.T_previous_keyframe);
    for (std::uint64_t c = 0; c < 8; ++c) {
      vision::KeyframeCorner corner;
      corner.landmark_id = c == 7 ? 0 : 100 + c + k;
      corner.px = Eigen::Vector2d(40.3 * static_cast<double>(c) + k, 200.0 / 3.0);
      corner.disparity_px = c == 3 ? -1.0 : 10.0 / static_cast<double>(c + 1);
      corner.disparity_sigma_px = 0.1;
      keyframe.corners.push_back(corner);
    }
    for (std::uint64_t d = 0; d < 16; ++d)
      keyframe.descriptors.push_back({d * 0x9e3779b97f4a7c15U, ~d, d << 40, 7U + k});
    map.keyframes.push_back(in_map);
  }
  for (std::uint64_t id = 100; id < 113; ++id)
    map.landmarks.push_back({id, Eigen::Vector3d(0.1 * static_cast<double>(id), -1.0 / 3.0, 4.0)});
  MapLoop loop;
  loop.from_id = 10;
  loop.to_id = 20;
  loop.T_from_to = map.keyframes[0].T_map_camera.inverse() * map.keyframes[5].T_map_camera *
                   Eigen::Translation3d(0.1, 0, 0);
  loop.covariance *= 1e-4;
  map.loops.push_back(loop);
  map.world = alignWithWorld({{{0, 0, 0}, {5, 5, 0}}, {{1, 0, 0}, {5, 7, 0}}, {{0, 1, 0}, {3.1, 5, 0}}},
                             {true, true});
  return map;
}

}  // namespace stereo_nav::mapping
