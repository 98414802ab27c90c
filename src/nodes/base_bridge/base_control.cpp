#include "nodes/base_bridge/base_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::nodes {
namespace {

using base::Mode;

std::int16_t toMillimetres(double speed_m_per_s) {
  return static_cast<std::int16_t>(std::lround(std::clamp(1e3 * speed_m_per_s, -32767.0, 32767.0)));
}

std::int32_t toMicroradians(double angle_rad) {
  return static_cast<std::int32_t>(std::lround(std::clamp(1e6 * angle_rad, -2.1e9, 2.1e9)));
}

}  // namespace

BaseControl::BaseControl(const ros_io::BaseBridgeParams& params, const kinematics::DriveParams& drive)
    : params_(params),
      commander_(drive, params.limits),
      wheels_(drive.wheels.size()),
      period_s_(1.0 / params.command_rate_hz),
      joint_urad_(params.joints.size()),
      actuator_permille_(params.actuators.size()) {
  if (wheels_ > base::kMaxWheels)
    throw ParameterError(
        fmt::format("the section drive has {} wheels, but the protocol of the base carries at most {}",
                    wheels_, base::kMaxWheels));
}

std::optional<std::string> BaseControl::setVelocity(const kinematics::Twist& twist, double now_s) {
  auto reason = obstacle(now_s);
  if (!reason && !twist.allFinite())
    reason = "it holds a value that is no number; its sender is at fault, and the base stops";
  if (reason) {
    ++velocities_refused_;
    velocity_.reset();
    return reason;
  }
  velocity_ = twist;
  velocity_s_ = now_s;
  return std::nullopt;
}

/// Servos and motors obey under the conditions under which wheels do: what is ordered in a stop or without a
/// line must not act later, by itself.
std::optional<std::string> BaseControl::refusalOfDevice(double value, double now_s) {
  auto reason = obstacle(now_s);
  if (!reason && !std::isfinite(value)) reason = "it is no number; its sender is at fault";
  if (reason) ++devices_refused_;
  return reason;
}

std::optional<std::string> BaseControl::setJoint(std::size_t joint, double angle_rad, double now_s) {
  if (const auto reason = refusalOfDevice(angle_rad, now_s)) return reason;
  const auto& limits = params_.joints[joint];
  joint_urad_[joint] =
      toMicroradians(kRadPerDeg * std::clamp(kDegPerRad * angle_rad, limits.min_deg, limits.max_deg));
  return std::nullopt;
}

std::optional<std::string> BaseControl::setActuator(std::size_t actuator, double level, double now_s) {
  if (const auto reason = refusalOfDevice(level, now_s)) return reason;
  actuator_permille_[actuator] = static_cast<std::int16_t>(std::lround(1e3 * std::clamp(level, -1.0, 1.0)));
  return std::nullopt;
}

void BaseControl::stop() {
  latched_ = true;
  releasing_ = false;
  order_sent_ = false;
  velocity_.reset();
  restActuators();
}

void BaseControl::release() {
  latched_ = false;
  releasing_ = true;
  order_sent_ = false;
  velocity_.reset();
  restActuators();
  knows_joints_ = false;
}

void BaseControl::restActuators() {
  std::fill(actuator_permille_.begin(), actuator_permille_.end(), std::int16_t{0});
}

void BaseControl::tick(double now_s) {
  if (guard_.tick(now_s) == 0.0) return;
  velocity_.reset();
  commander_.halt();
}

void BaseControl::addTelemetry(const base::Telemetry& telemetry, double now_s) {
  if (!hearsTelemetry(now_s)) restActuators();  // as the controller did; nothing starts again by itself
  telemetry_ = telemetry;
  telemetry_s_ = now_s;
  if (!knows_joints_ && fits(telemetry)) {
    // A node that begins, or begins again, and the end of a stop leave the servos where they are.
    std::copy(telemetry.joint_urad, telemetry.joint_urad + telemetry.joints, joint_urad_.begin());
    knows_joints_ = true;
  }
  if (releasing_ && confirmed(now_s)) releasing_ = false;
  // The stop of a node that ended before this one began, or of a switch at the controller.
  const bool is_stopped = telemetry.mode == static_cast<std::uint8_t>(Mode::kStopped);
  if (is_stopped && !latched_ && !releasing_ && order_sent_) stop();
}

bool BaseControl::confirmed(double now_s) const {
  if (!order_sent_ || !hearsTelemetry(now_s)) return false;
  const auto since = static_cast<std::int16_t>(telemetry_->command_sequence - order_sequence_);
  const bool is_stopped = telemetry_->mode == static_cast<std::uint8_t>(Mode::kStopped);
  return since >= 0 && is_stopped == latched_;
}

bool BaseControl::hearsTelemetry(double now_s) const {
  return telemetry_ && now_s - telemetry_s_ <= params_.telemetry_timeout_s;
}

bool BaseControl::fits(const base::Telemetry& telemetry) const {
  return telemetry.wheels == wheels_ && telemetry.joints == params_.joints.size() &&
         telemetry.ranges == params_.ranges.size() && telemetry.actuators == params_.actuators.size();
}

std::optional<std::string> BaseControl::obstacle(double now_s) const {
  if (latched_) return "the base is stopped; the service base/release lets it drive again";
  if (releasing_) return "the controller has not confirmed base/release yet";
  if (guard_.blocks(now_s))
    return "base_bridge stood still, so that it may have waited for longer than it shows: this computer is "
           "overloaded or was suspended, or the program was stopped by a signal";
  if (!hearsTelemetry(now_s))
    return "no telemetry from the controller, so that nobody would see what the base does; the diagnostics say what is "
           "wrong with the line";
  if (fits(*telemetry_)) return std::nullopt;
  const base::Telemetry& t = *telemetry_;
  return fmt::format(
      "the controller has {} wheels, {} joints, {} range finders and {} actuators, the rig file {}, {}, {} and {}: the "
      "controller's program or the rig file (sections drive and base) is that of another robot",
      t.wheels, t.joints, t.ranges, t.actuators, wheels_, params_.joints.size(), params_.ranges.size(),
      params_.actuators.size());
}

base::Command BaseControl::emptyCommand() {
  base::Command command{};
  command.sequence = sequence_++;
  command.wheels = static_cast<std::uint8_t>(wheels_);
  command.joints = static_cast<std::uint8_t>(knows_joints_ ? joint_urad_.size() : 0);
  command.actuators = static_cast<std::uint8_t>(actuator_permille_.size());
  std::copy(joint_urad_.begin(), joint_urad_.end(), command.joint_urad);
  return command;
}

std::optional<base::Command> BaseControl::step(double now_s) {
  if (!knows_joints_ && !latched_) return std::nullopt;
  base::Command command = emptyCommand();
  if (latched_) command.flags = base::kStop;
  if (releasing_) command.flags = base::kRelease;
  const bool hears = hearsTelemetry(now_s);
  // Numbers are compared modulo 2^16: an order that nobody confirms for minutes must not look like a later
  // one.
  if (!order_sent_ || !hears) order_sequence_ = command.sequence;
  order_sent_ = true;
  if (!hears) restActuators();
  std::copy(actuator_permille_.begin(), actuator_permille_.end(), command.actuator_permille);
  const bool is_fresh = velocity_ && now_s - velocity_s_ < params_.cmd_vel_timeout_s;
  if (velocity_ && !is_fresh) {
    if (!velocity_->isZero()) ++timed_out_;
    velocity_.reset();
  }
  drives_ = is_fresh && !obstacle(now_s);
  if (drives_) {
    fillWheels(command, now_s);
  } else {
    commander_.halt();
  }
  return command;
}

void BaseControl::fillWheels(base::Command& command, double now_s) {
  std::vector<double> steering_rad;
  for (std::size_t i = 0; i < wheels_; ++i) steering_rad.push_back(1e-6 * telemetry_->steering_urad[i]);
  const auto wheels = commander_.command(*velocity_, period_s_, steering_rad);
  for (std::size_t i = 0; i < wheels_; ++i) {
    command.speed_mm_per_s[i] = toMillimetres(wheels[i].speed_m_per_s);
    command.steering_urad[i] = toMicroradians(wheels[i].steering_rad);
  }
  // Rounded down: the controller's time is over no later than ours.
  command.valid_ms =
      static_cast<std::uint16_t>(std::floor(1e3 * (velocity_s_ + params_.cmd_vel_timeout_s - now_s)));
}

std::optional<base::Command> BaseControl::farewell() {
  if (!knows_joints_ && !latched_) return std::nullopt;
  base::Command command = emptyCommand();
  if (latched_) command.flags = base::kStop;
  return command;
}

}  // namespace stereo_nav::nodes
