#pragma once

#include <optional>
#include <vector>

#include "mapping/loop/landmark_match.h"

namespace stereo_nav::mapping {

/// The most likely pose of a place in the query's camera.
struct LoopPose {
  Eigen::Isometry3d T_query_place = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of the left perturbation: m, m, m, rad, rad, rad
  std::vector<bool> inlier;                ///< per match: within the 99 % bound of its own noise
  std::size_t inliers = 0;
};

/// Gauss-Newton with a Cauchy loss on column, row and disparity of all matches, each weighted by the noise of
/// both corners, from the guess on. The covariance is that of the robust estimate (Huber 1981, chapter 7),
/// with noise as large as the residuals tell. Nothing if the matches do not determine the pose.
std::optional<LoopPose> refineLoopPose(const vision::StereoCalibration& calibration,
                                       const std::vector<LandmarkMatch>& matches,
                                       const Eigen::Isometry3d& T_query_place);

}  // namespace stereo_nav::mapping
