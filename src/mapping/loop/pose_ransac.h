#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mapping/loop/landmark_match.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::mapping {

struct RansacParams {
  int iterations = 100;
  double max_error_px = 4.0;

  void describe(ParameterVisitor& visitor);
};

/// A pose on which many matches agree.
struct RansacPose {
  Eigen::Isometry3d T_query_place = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> inliers;  ///< indices into the matches, increasing
};

/// The pose of the place in the query's camera on which most matches agree, from samples of three (P3P, Gao
/// et al. 2003) and a fourth that chooses among the solutions (Fischler and Bolles 1981). The number of
/// samples is counted: at most `iterations`, fewer once 99.9 % of the runs would have found so many inliers.
/// The same `seed` gives the same samples. Nothing if no sample gives a pose.
std::optional<RansacPose> ransacPose(const RansacParams& params, const vision::StereoCalibration& calibration,
                                     const std::vector<LandmarkMatch>& matches, std::uint64_t seed);

}  // namespace stereo_nav::mapping
