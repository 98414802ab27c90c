#pragma once

#include <string>
#include <vector>

#include "estimation/ekf/fusion_config.h"
#include "sim/trajectory.h"
#include "tools/fusion_experiment/sensor_runs.h"

namespace stereo_nav::tools {

/// The sensors that are used.
struct Subset {
  bool wheels = false, laser = false, imu = false, stereo = false, ranges = false;

  /// `wheels laser`, in this order.
  std::string name() const;
};

/// All that can tell a pose: one of the odometries at least.
std::vector<Subset> allSubsets();

/// Where the robot is said to be, and where it is, at one instant.
struct ComparedPose {
  double time_s;
  Eigen::Isometry2d T_true;
  Eigen::Vector3d error;  ///< x m, y m (axes of the world), yaw rad
  double nees;            ///< of the three
};

/// The filter of `config` (config/fusion/planar.yaml) over the sensors of a subset, 10 poses a second. With
/// ranges the pose is that of range_correction in the map, whose odometry is the filter.
std::vector<ComparedPose> runSubset(const estimation::FusionConfig& config, const Subset& subset,
                                    const SensorRuns& runs, const sim::Trajectory& trajectory);

}  // namespace stereo_nav::tools
