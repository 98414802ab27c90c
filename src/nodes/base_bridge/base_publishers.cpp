#include "nodes/base_bridge/base_publishers.h"

#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include <utility>

#include "ros/device_messages.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::uint32_t kQueue = 100;
constexpr double kBatteryPeriod_s = 1.0;

bool isPressed(const base::Telemetry& telemetry, std::size_t i) {
  return ((telemetry.switches >> i) & 1U) != 0;
}

}  // namespace

BasePublishers::BasePublishers(ros::NodeHandle handle, const ros_io::BaseBridgeParams& params,
                               kinematics::DriveParams drive)
    : params_(params), drive_(std::move(drive)) {
  ticks_ = handle.advertise<WheelTicks>(ros_io::topics::kWheelTicks, kQueue);
  joint_states_ = handle.advertise<sensor_msgs::JointState>(ros_io::topics::kJointStates, kQueue);
  battery_ = handle.advertise<sensor_msgs::BatteryState>(ros_io::topics::kBattery, 1, true);
  for (const auto& finder : params_.ranges)
    ranges_.push_back(handle.advertise<sensor_msgs::Range>(ros_io::topics::kRange + finder.name, kQueue));
  for (const auto& item : params_.switches)
    switches_.push_back(handle.advertise<std_msgs::Bool>(ros_io::topics::kSwitch + item.name, 1, true));
  for (const auto& item : params_.actuators)
    actuators_.push_back(handle.advertise<std_msgs::Float64>(
        ros_io::topics::kActuator + item.name + ros_io::topics::kActuatorState, 1, true));
}

void BasePublishers::publish(const base::BaseReading& reading) {
  const base::Telemetry& telemetry = reading.telemetry;
  const ros::Time stamp = stamps_.at(reading.time_s);
  ticks_.publish(ros_io::toWheelTicks(telemetry, drive_, params_.base_frame, stamp));
  joint_states_.publish(ros_io::toJointState(telemetry, drive_, params_, stamp));
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    ranges_[i].publish(ros_io::toRange(telemetry.range_mm[i], params_.ranges[i], stamp));
  if (telemetry.battery_mV > 0 && reading.arrival_s - battery_s_ >= kBatteryPeriod_s) {
    battery_s_ = reading.arrival_s;
    battery_.publish(ros_io::toBatteryState(telemetry.battery_mV, params_, stamp));
  }
  publishChanges(telemetry);
  last_ = telemetry;
}

void BasePublishers::publishChanges(const base::Telemetry& telemetry) {
  for (std::size_t i = 0; i < switches_.size(); ++i) {
    if (last_ && isPressed(*last_, i) == isPressed(telemetry, i)) continue;
    std_msgs::Bool message;
    message.data = static_cast<unsigned char>(isPressed(telemetry, i));
    switches_[i].publish(message);
  }
  for (std::size_t i = 0; i < actuators_.size(); ++i) {
    if (last_ && last_->actuator_permille[i] == telemetry.actuator_permille[i]) continue;
    std_msgs::Float64 message;
    message.data = 1e-3 * telemetry.actuator_permille[i];
    actuators_[i].publish(message);
  }
}

}  // namespace stereo_nav::nodes
