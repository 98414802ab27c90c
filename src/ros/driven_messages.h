#pragma once

#include <geometry_msgs/Quaternion.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>

#include <memory>
#include <string>
#include <vector>

#include "ros/driven_rig.h"
#include "ros/sensor_messages.h"
#include "sensors/base/controller/protocol.h"
#include "sim/driven_simulation.h"
#include "stereo_nav/Contacts.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::ros_io {

/// stereo_nav/Contacts: what a driven simulated robot touches.
constexpr const char* kContactsTopic = "ground_truth/contacts";

/// What a driven robot's sensors deliver, as the messages of the bridges. The frame `odom` of the ground
/// truth is where the robot started. Const methods may be called from several threads.
class DrivenMessages {
 public:
  /// `start` is the stamp of simulation time 0. Throws InputError for a calibration that judgeInfos()
  /// refuses.
  DrivenMessages(const sim::DrivenSimulation& simulation, const DrivenDevices& devices,
                 const Eigen::Isometry3d& T_base_imu, const ros::Time& start);

  ros::Time stamp(double time_s) const { return start_ + ros::Duration(time_s); }
  /// What the microcontroller of the base would have measured.
  base::Telemetry telemetry(const sim::SimulatedTicks& ticks) const;
  WheelTicks wheelTicks(const sim::SimulatedTicks& ticks) const;
  sensor_msgs::JointState jointState(const sim::SimulatedTicks& ticks) const;
  nav_msgs::Odometry groundTruth(const sim::BaseState& state, double time_s) const;
  sensor_msgs::Imu imu(const ImuSample& sample) const;
  sensor_msgs::LaserScan scan(const laser::Scan& scan) const;
  std::string rangeTopic(std::size_t finder) const;
  sensor_msgs::Range range(std::size_t finder, double time_s, double range_m) const;
  Contacts contacts(double time_s, const std::vector<std::string>& names) const;
  /// Renders both images, on two threads where that is wanted.
  PairMessages pair(const sim::StereoShot& shot, bool on_two_threads = false) const;
  tf2_msgs::TFMessage staticTransforms() const;

 private:
  DrivenDevices devices_;
  std::shared_ptr<const sim::StereoCameras> cameras_;
  double readout_s_;
  Eigen::Isometry3d T_start_world_, T_base_camera_, T_base_imu_;
  ros::Time start_;
};

}  // namespace stereo_nav::ros_io
