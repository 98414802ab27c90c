#pragma once

#include <Eigen/Core>
#include <vector>

#include "odometry/laser/range_scan.h"

namespace stereo_nav::odometry {

/// Velocity of a laser along the axes of its RangeScan: m/s, m/s, rad/s.
struct LaserVelocity {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double inlier_share = 0.0;  ///< of the beams, whose residuals the loss lets count by half or more
};

/// Jaimez, Monroy and Gonzalez-Jimenez 2016, "Planar odometry from a radial laser scanner. A range flow-based
/// approach" (ICRA; the method of rf2o), from its equations: each beam gives a linear equation of the
/// velocity between two scans; a pyramid of scans takes it from the coarsest to the finest.
/// The constants of the pre-weighting and of the loss are our own, and so is the motion filter's weight of
/// eigenvalues: it follows from what a velocity may change by between two scans.
class RangeFlow {
 public:
  /// The velocity since the scan before, which came `duration_s` earlier. Zero with a standard deviation of
  /// 1 m/s and 1 rad/s, and no inliers, where there was none, one of other beams, or where too few beams have
  /// a range in both.
  LaserVelocity follow(const RangeScan& scan, double duration_s);

 private:
  std::vector<RangeScan> before_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace stereo_nav::odometry
