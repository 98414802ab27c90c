#include "ros/driven_messages.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "ros/device_messages.h"
#include "ros/judged_infos.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

/// As the controller sends ranges.
std::uint16_t millimetres(double range_m) {
  if (std::isnan(range_m)) return base::kRangeUnknown;
  if (std::isinf(range_m)) return range_m > 0.0 ? base::kRangeNothing : base::kRangeTooNear;
  return static_cast<std::uint16_t>(std::clamp(std::lround(1e3 * range_m), 1L, 60000L));
}

}  // namespace

DrivenMessages::DrivenMessages(const sim::DrivenSimulation& simulation, const DrivenDevices& devices,
                               const Eigen::Isometry3d& T_base_imu, const ros::Time& start)
    : devices_(devices),
      cameras_(simulation.cameras()),
      readout_s_(1e-3 * simulation.scenario().sensor.rolling_shutter_ms),
      T_start_world_(simulation.start().inverse()),
      T_base_camera_(simulation.scenario().rig.T_base_camera()),
      T_base_imu_(T_base_imu),
      start_(start) {
  judgeInfos(toCameraInfo(cameras_->calibration(sim::Side::kLeft), {}),
             toCameraInfo(cameras_->calibration(sim::Side::kRight), {}));
}

base::Telemetry DrivenMessages::telemetry(const sim::SimulatedTicks& ticks) const {
  base::Telemetry telemetry{};
  telemetry.wheels = static_cast<std::uint8_t>(ticks.pulses.size());
  for (std::size_t i = 0; i < ticks.pulses.size(); ++i) {
    telemetry.pulses[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(ticks.pulses[i]));
    if (!ticks.steering_rad.empty())
      telemetry.steering_urad[i] = static_cast<std::int32_t>(std::lround(1e6 * ticks.steering_rad[i]));
  }
  return telemetry;
}

WheelTicks DrivenMessages::wheelTicks(const sim::SimulatedTicks& ticks) const {
  return toWheelTicks(telemetry(ticks), devices_.rig.drive, devices_.base.base_frame, stamp(ticks.time_s));
}

sensor_msgs::JointState DrivenMessages::jointState(const sim::SimulatedTicks& ticks) const {
  return toJointState(telemetry(ticks), devices_.rig.drive, devices_.base, stamp(ticks.time_s));
}

nav_msgs::Odometry DrivenMessages::groundTruth(const sim::BaseState& state, double time_s) const {
  sim::BaseState from_start = state;
  from_start.T_world_base = T_start_world_ * state.T_world_base;
  return toOdometry(from_start, stamp(time_s));
}

sensor_msgs::Imu DrivenMessages::imu(const ImuSample& sample) const {
  return toImu(sample, stamp(sample.time_s), T_base_imu_);
}

sensor_msgs::LaserScan DrivenMessages::scan(const laser::Scan& scan) const {
  return toMessage(scan, devices_.laser, stamp(scan.time_s));
}

std::string DrivenMessages::rangeTopic(std::size_t finder) const {
  const std::size_t of_base = devices_.base.ranges.size();
  return topics::kRange + (finder < of_base ? devices_.base.ranges[finder].name
                                            : devices_.finders.finders[finder - of_base].name);
}

sensor_msgs::Range DrivenMessages::range(std::size_t finder, double time_s, double range_m) const {
  const std::size_t of_base = devices_.base.ranges.size();
  if (finder < of_base) return toRange(millimetres(range_m), devices_.base.ranges[finder], stamp(time_s));
  return toMessage(range_m, devices_.finders.finders[finder - of_base], stamp(time_s));
}

Contacts DrivenMessages::contacts(double time_s, const std::vector<std::string>& names) const {
  Contacts message;
  message.header.stamp = stamp(time_s);
  message.header.frame_id = frames::kBase;
  message.names = names;
  return message;
}

PairMessages DrivenMessages::pair(const sim::StereoShot& shot, bool on_two_threads) const {
  const auto taken = [&](sim::Side side) {
    return TakenImage{shot.image(side, *cameras_), &cameras_->calibration(side),
                      1e-3 * shot.exposure(side).exposure_ms};
  };
  const auto policy = on_two_threads ? std::launch::async : std::launch::deferred;
  auto left = std::async(policy, taken, sim::Side::kLeft);
  const TakenImage right = taken(sim::Side::kRight);
  return toPairMessages(shot.index, shot.instants, left.get(), right, readout_s_, start_);
}

tf2_msgs::TFMessage DrivenMessages::staticTransforms() const {
  return toStaticTransforms(T_base_camera_, cameras_->calibration(sim::Side::kRight).offsetX_m(), T_base_imu_,
                            start_);
}

}  // namespace stereo_nav::ros_io
