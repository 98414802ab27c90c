#pragma once

#include <vector>

#include "mapping/loop/descriptor_matching.h"
#include "mapping/loop/keyframe_chain.h"
#include "mapping/loop/landmark_match.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::mapping {

struct LandmarkSearchParams {
  int neighbours = 3;
  double radius_px = 8.0;
  int max_distance = 64;

  void describe(ParameterVisitor& visitor);
};

/// Looks for the landmarks of a place and of its neighbours in the query, where a first pose has them: each
/// landmark takes the most similar corner within `radius_px` that no landmark before it has taken. `matches`
/// are those between place and query that the pose rests on; their corners are taken. Returns all matches,
/// theirs first.
std::vector<LandmarkMatch> searchNeighbours(const LandmarkSearchParams& params,
                                            const vision::StereoCalibration& calibration,
                                            const KeyframeChain& chain, std::size_t place,
                                            const vision::Keyframe& query,
                                            const Eigen::Isometry3d& T_query_place,
                                            const std::vector<CornerMatch>& matches);

}  // namespace stereo_nav::mapping
