#pragma once

#include <Eigen/Geometry>

#include "odometry/laser/pose_filter.h"

namespace stereo_nav::odometry {

/// The filter after a scan.
struct FilterMoment {
  Eigen::Isometry2d T_odom_base = Eigen::Isometry2d::Identity();
  Matrix9d covariance = Matrix9d::Zero();
};

inline FilterMoment momentOf(const PoseFilter& filter) {
  return {filter.state().T_odom_base(), filter.covariance()};
}

/// Covariance (forward m, left m, rad in the axes of the later base) of the motion between two moments.
/// `transition` takes the nine errors of the earlier one to those of the later one: the product of
/// PoseFilter::transition() of the steps between them, the last one leftmost.
Eigen::Matrix3d motionCovariance(const FilterMoment& from, const Matrix9d& transition,
                                 const FilterMoment& to);

}  // namespace stereo_nav::odometry
