#pragma once

#include <array>
#include <string>

#include "estimation/ekf/filter_params.h"

namespace stereo_nav::estimation {

/// Single values of the file of a filter, node and program. The names are robot_localization's where it has
/// them.
struct FusionParams {
  double frequency_hz = 30.0;
  bool two_d_mode = false;
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_link_frame = "base_link";
  std::string world_frame = "odom";
  bool publish_tf = true;
  bool publish_acceleration = false;
  bool predict_to_current_time = false;
  double transform_time_offset_s = 0.0;
  double sensor_timeout_s = 1.0;
  bool disabled_at_startup = false;
  FilterParams filter;

  void describe(ParameterVisitor& visitor);
};

/// Single values of one sensor: `odom0_differential`, ...
struct FusedSensorParams {
  bool differential = false;
  bool relative = false;
  bool absolute = false;
  bool wheel_scales = false;
  int queue_size = 10;
  bool nodelay = false;
  double pose_rejection_threshold = 0.0;
  double twist_rejection_threshold = 0.0;
  double linear_acceleration_rejection_threshold = 0.0;
  bool remove_gravitational_acceleration = false;
  double reading_sigma_m = 0.005;
  double reading_sigma_rad = 0.002;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::estimation
