#include "ros/device_messages.h"

#include <algorithm>
#include <limits>

#include "core/angles.h"

namespace stereo_nav::ros_io {

using kinematics::WheelKind;

WheelTicks toWheelTicks(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                        const std::string& frame, ros::Time stamp) {
  WheelTicks message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  bool any_steered = false;
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    message.names.push_back(drive.wheels[i].name);
    message.pulses.push_back(telemetry.pulses[i]);
    message.steering_rad.push_back(1e-6 * telemetry.steering_urad[i]);
    any_steered = any_steered || drive.wheels[i].kind == WheelKind::kSteered;
  }
  if (!any_steered) message.steering_rad.clear();
  return message;
}

sensor_msgs::JointState toJointState(const base::Telemetry& telemetry, const kinematics::DriveParams& drive,
                                     const BaseBridgeParams& params, ros::Time stamp) {
  sensor_msgs::JointState message;
  message.header.stamp = stamp;
  message.header.frame_id = params.base_frame;
  const auto add = [&message](const std::string& name, double position_rad) {
    message.name.push_back(name);
    message.position.push_back(position_rad);
  };
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    const auto& wheel = drive.wheels[i];
    if (wheel.kind == WheelKind::kSteered) add(wheel.name + "_steering", 1e-6 * telemetry.steering_urad[i]);
    add(wheel.name + "_wheel", telemetry.pulses[i] * wheel.metresPerPulse() / wheel.radius_m);
  }
  for (std::size_t i = 0; i < params.joints.size(); ++i)
    add(params.joints[i].name, 1e-6 * telemetry.joint_urad[i]);
  return message;
}

sensor_msgs::Range toRange(std::uint16_t range_mm, const BaseRangeParams& finder, ros::Time stamp) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  sensor_msgs::Range message;
  message.header.stamp = stamp;
  message.header.frame_id = finder.frame();
  message.radiation_type = finder.ultrasound ? sensor_msgs::Range::ULTRASOUND : sensor_msgs::Range::INFRARED;
  message.field_of_view = static_cast<float>(kRadPerDeg * finder.field_of_view_deg);
  message.min_range = static_cast<float>(finder.min_range_m);
  message.max_range = static_cast<float>(finder.max_range_m);
  message.range = 1e-3F * static_cast<float>(range_mm);
  if (range_mm == base::kRangeTooNear || message.range < message.min_range) message.range = -kInfinity;
  if (range_mm == base::kRangeNothing || message.range > message.max_range) message.range = kInfinity;
  if (range_mm == base::kRangeUnknown) message.range = std::numeric_limits<float>::quiet_NaN();
  return message;
}

sensor_msgs::BatteryState toBatteryState(std::uint16_t battery_mV, const BaseBridgeParams& params,
                                         ros::Time stamp) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  using Battery = sensor_msgs::BatteryState;
  Battery message;
  message.header.stamp = stamp;
  message.voltage = 1e-3F * static_cast<float>(battery_mV);
  message.current = message.charge = message.capacity = message.design_capacity = message.percentage =
      kUnknown;
  const double span_V = params.battery_full_V - params.battery_empty_V;
  if (span_V > 0.0)
    message.percentage =
        static_cast<float>(std::clamp((1e-3 * battery_mV - params.battery_empty_V) / span_V, 0.0, 1.0));
  message.power_supply_status = Battery::POWER_SUPPLY_STATUS_DISCHARGING;
  message.power_supply_health = Battery::POWER_SUPPLY_HEALTH_UNKNOWN;
  message.power_supply_technology = Battery::POWER_SUPPLY_TECHNOLOGY_UNKNOWN;
  message.present = 1;
  return message;
}

sensor_msgs::LaserScan toMessage(const laser::Scan& scan, const LaserBridgeParams& params, ros::Time stamp) {
  sensor_msgs::LaserScan message;
  message.header.stamp = stamp;
  message.header.frame_id = params.frame_id;
  const auto beams = static_cast<double>(scan.ranges_m.size());
  message.angle_min = 0.0F;
  message.angle_increment = static_cast<float>(-2.0 * kPi / beams);
  message.angle_max = static_cast<float>(-2.0 * kPi * (beams - 1.0) / beams);
  message.time_increment = static_cast<float>(scan.time_increment_s);
  message.scan_time = static_cast<float>(scan.scan_time_s);
  message.range_min = static_cast<float>(params.device.scan.range_min_m);
  message.range_max = static_cast<float>(params.device.scan.range_max_m);
  message.ranges = scan.ranges_m;
  message.intensities = scan.qualities;
  return message;
}

sensor_msgs::Range toMessage(double range_m, const RangeFinderParams& finder, ros::Time stamp) {
  sensor_msgs::Range message;
  message.header.stamp = stamp;
  message.header.frame_id = finder.frame();
  message.radiation_type = sensor_msgs::Range::INFRARED;
  message.field_of_view = static_cast<float>(kRadPerDeg * finder.field_of_view_deg);
  message.min_range = static_cast<float>(finder.device.range_min_m);
  message.max_range = static_cast<float>(finder.device.range_max_m);
  message.range = static_cast<float>(range_m);
  return message;
}

}  // namespace stereo_nav::ros_io
