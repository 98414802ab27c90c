#pragma once

#include <ros/ros.h>

#include <optional>
#include <vector>

#include "ros/base_bridge_params.h"
#include "ros/steady_stamps.h"
#include "sensors/base/base_device.h"

namespace stereo_nav::nodes {

/// What the controller measures, on its topics. Switches and actuators are published when they change, and
/// latched; the battery once a second.
class BasePublishers {
 public:
  BasePublishers(ros::NodeHandle handle, const ros_io::BaseBridgeParams& params,
                 kinematics::DriveParams drive);

  /// The telemetry must have the counts of the parameters.
  void publish(const base::BaseReading& reading);

 private:
  void publishChanges(const base::Telemetry& telemetry);

  ros_io::BaseBridgeParams params_;
  kinematics::DriveParams drive_;
  ros_io::SteadyStamps stamps_;
  ros::Publisher ticks_, joint_states_, battery_;
  std::vector<ros::Publisher> ranges_, switches_, actuators_;
  std::optional<base::Telemetry> last_;
  double battery_s_ = -1e9;
};

}  // namespace stereo_nav::nodes
