#include "tools/build_map/map_builder.h"

#include <map>

namespace stereo_nav::tools {
namespace {

/// Best known of the sightings of a landmark.
struct Sighting {
  Eigen::Vector3d p_map;
  double sigma_m;
};

/// Deviation of the depth that a disparity tells.
double depthSigma(const vision::StereoCalibration& calibration, const vision::KeyframeCorner& corner) {
  return calibration.fx * calibration.baseline_m * corner.disparity_sigma_px /
         (corner.disparity_px * corner.disparity_px);
}

}  // namespace

MapBuilder::MapBuilder(const mapping::LoopParams& loops, const mapping::RobustParams& closing,
                       const vision::StereoCalibration& calibration)
    : closing_(closing), calibration_(calibration), finder_(loops, calibration) {
  map_.calibration_hash = mapping::calibrationHash(calibration);
}

std::vector<mapping::LoopCandidate> MapBuilder::add(const vision::Keyframe& keyframe,
                                                    const Eigen::Isometry3d& T_odom_camera) {
  const auto candidates = finder_.add(keyframe);
  mapping::MapKeyframe added{keyframe, T_odom_camera};
  const std::size_t newest = finder_.chain().size() - 1;
  // With what all motions share and the odometry's covariance leaves out.
  if (keyframe.follows && newest > 0)
    if (const auto motion = finder_.chain().relative(newest - 1, newest))
      added.keyframe.covariance = motion->covariance;
  map_.keyframes.push_back(added);
  for (const mapping::LoopCandidate& candidate : candidates) {
    if (!candidate.accepted()) continue;
    map_.loops.push_back({candidate.place_id, candidate.query_id, candidate.place_query.T,
                          candidate.place_query.covariance, true});
  }
  return candidates;
}

void MapBuilder::close() {
  verdicts_.clear();
  if (!map_.loops.empty()) {
    mapping::SpatialGraph graph = mapping::graphOf(map_);
    verdicts_ = mapping::optimiseRobustly(graph, closing_).loops;
    for (std::size_t k = 0; k < graph.poses.size(); ++k) map_.keyframes[k].T_map_camera = graph.poses[k];
    const std::size_t first_loop = graph.edges.size() - map_.loops.size();
    for (const mapping::LoopVerdict& verdict : verdicts_)
      map_.loops[verdict.edge - first_loop].kept = verdict.kept;
  }
  placeLandmarks();
}

void MapBuilder::placeLandmarks() {
  std::map<std::uint64_t, Sighting> sightings;
  for (const mapping::MapKeyframe& keyframe : map_.keyframes) {
    for (const vision::KeyframeCorner& corner : keyframe.keyframe.corners) {
      if (!corner.hasDepth() || corner.landmark_id == 0) continue;
      const double sigma_m = depthSigma(calibration_, corner);
      const auto known = sightings.find(corner.landmark_id);
      if (known != sightings.end() && known->second.sigma_m <= sigma_m) continue;
      const Eigen::Vector3d p_camera =
          calibration_.backProject(corner.px.x(), corner.px.y(), corner.disparity_px);
      sightings[corner.landmark_id] = {keyframe.T_map_camera * p_camera, sigma_m};
    }
  }
  map_.landmarks.clear();
  for (const auto& [id, sighting] : sightings) map_.landmarks.push_back({id, sighting.p_map});
}

}  // namespace stereo_nav::tools
