#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mapping/map/pose_graph.h"
#include "mapping/map/world_alignment.h"
#include "stereo_nav/vision/stereo_calibration.h"
#include "vision/keyframe.h"

namespace stereo_nav::mapping {

/// A keyframe, what the odometry said of it, and where it is.
struct MapKeyframe {
  vision::Keyframe keyframe;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();  ///< left optical frame
};

struct MapLandmark {
  std::uint64_t id = 0;  ///< KeyframeCorner::landmark_id
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
};

/// A motion between two keyframes that was recognised.
struct MapLoop {
  std::uint32_t from_id = 0, to_id = 0;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< right perturbation, axes of `to`: m, m, m, rad, rad, rad
  bool kept = true;                            ///< whether it counted when the poses were computed
};

/// All that a map file holds. Edges of the odometry are those of the keyframes that follow their predecessor.
struct VisualMap {
  std::uint64_t calibration_hash = 0;  ///< calibrationHash() of the cameras that saw it
  std::vector<MapKeyframe> keyframes;  ///< ids increase
  std::vector<MapLandmark> landmarks;  ///< ids increase
  std::vector<MapLoop> loops;
  std::optional<WorldTransform> world;
};

/// Position of a keyframe in the map; nothing where the map does not have it.
std::optional<std::size_t> indexOfKeyframe(const VisualMap& map, std::uint32_t id);

/// A number that tells rectified pairs apart: FNV-1a over the eight numbers of the calibration.
std::uint64_t calibrationHash(const vision::StereoCalibration& calibration);

/// Throws InputError when the map was made with other cameras or another calibration.
void requireCalibration(const VisualMap& map, const vision::StereoCalibration& calibration);

/// The map as a pose graph: a vertex a keyframe, its edges those of the odometry and all loops, kept or not.
/// Covariances become informations of g2o's error.
SpatialGraph graphOf(const VisualMap& map);

}  // namespace stereo_nav::mapping
