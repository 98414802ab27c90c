#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/vision/stereo_calibration.h"
#include "vision/keyframe.h"

namespace stereo_nav::mapping {

/// A landmark of a known place and the corner of the query that may show it.
struct LandmarkMatch {
  Eigen::Vector3d p_place = Eigen::Vector3d::Zero();     ///< frame of the place's keyframe, m
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of p_place, m^2
  vision::KeyframeCorner seen;                           ///< in the query
};

/// Standard deviation of the position of a corner against that of the same corner in another image, each
/// detected on its own, per coordinate.
constexpr double kCornerSigma_px = 0.7;

/// Point and covariance of a corner with depth in the frame of its own keyframe; those of the match stay.
void setPoint(const vision::StereoCalibration& calibration, const vision::KeyframeCorner& corner,
              LandmarkMatch& match);

/// Left column, row, disparity of a point in the camera frame of the query; z must be positive.
Eigen::Vector3d measurementOf(const vision::StereoCalibration& calibration, const Eigen::Vector3d& p_query);
/// Its derivative by the point.
Eigen::Matrix3d measurementJacobian(const vision::StereoCalibration& calibration,
                                    const Eigen::Vector3d& p_query);

/// How far a match is from where a pose T_query_place would have it.
struct MatchResidual {
  Eigen::Vector3d error;                ///< observed - projected: column, row, disparity, px
  Eigen::Matrix3d information;          ///< of the error; no disparity: its row and column are zero
  Eigen::Matrix<double, 3, 6> by_pose;  ///< of the projection, left perturbation of T_query_place
  int dimensions = 0;
  double squared = 0.0;  ///< error^T information error
};
/// Nothing where the point would not be in front of the camera.
std::optional<MatchResidual> residualOf(const vision::StereoCalibration& calibration,
                                        const Eigen::Isometry3d& T_query_place, const LandmarkMatch& match);

}  // namespace stereo_nav::mapping
