#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "kinematics/wheel_commander.h"
#include "sensors/laser/scan_assembler.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// How a driven robot answers commands, and what of it can touch things.
struct DrivenParams {
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double start_yaw_deg = 0.0;
  double longest_s = 3600.0;
  double dead_time_s = 0.02;
  double lag_s = 0.05;
  double max_acceleration_mps2 = 3.0;
  double steering_lag_s = 0.03;
  double length_m = 0.5;
  double width_m = 0.4;
  double height_m = 0.5;
  double clearance_m = 0.02;

  void describe(ParameterVisitor& visitor);
};

/// Errors of the simulated laser.
struct LaserModelParams {
  double rate_hz = 10.0;
  double noise_m = 0.005;
  double noise_share = 0.0;
  double dropout = 0.005;

  void describe(ParameterVisitor& visitor);
};

/// Errors of the simulated range finders.
struct RangeModelParams {
  double rate_hz = 20.0;
  double noise_m = 0.01;

  void describe(ParameterVisitor& visitor);
};

/// A laser as it is mounted.
struct LaserRig {
  Eigen::Isometry3d T_base_laser = Eigen::Isometry3d::Identity();
  laser::ScanParams scan;
};

/// A range finder as it is mounted; it looks along its x axis.
struct RangeRig {
  Eigen::Isometry3d T_base_sensor = Eigen::Isometry3d::Identity();
  double field_of_view_rad = 0.06;
  double range_min_m = 0.1;
  double range_max_m = 12.0;
};

/// What a driven robot carries, by its rig file.
struct DrivenRig {
  kinematics::DriveParams drive;  ///< the nominal wheels
  kinematics::WheelLimits limits;
  double command_rate_hz = 50.0;
  double cmd_vel_timeout_s = 0.3;
  std::vector<LaserRig> lasers;  ///< none or one
  std::vector<RangeRig> ranges;
};

}  // namespace stereo_nav::sim
