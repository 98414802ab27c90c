#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "odometry/laser/laser_scan.h"
#include "odometry/laser/pose_filter.h"

namespace stereo_nav::odometry {

/// The motion of the base while a scan is taken, which distorts the scan.
class Sweep {
 public:
  /// `motion` of the sweep, from its first beam to its last.
  Sweep(const PoseFilter& filter, const MeasuredMotion& motion) : filter_(filter), motion_(motion) {}

  /// The points as they would be seen from the base at the first beam.
  void undistort(const LaserPoints& scan, const Eigen::Vector3d& correction,
                 std::vector<Eigen::Vector2d>& p_base) const;
  /// Whether the correction of the translation is the scale of wheels.
  bool scaled() const { return motion_.translation == RateSource::kWheels; }
  /// d rate / d correction, mean of the sweep.
  Eigen::Vector3d gain() const;

 private:
  const PoseFilter& filter_;
  const MeasuredMotion& motion_;
};

}  // namespace stereo_nav::odometry
