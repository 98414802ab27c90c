#include "sim/driven_base.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::sim {
namespace {

/// Rate of a steering axis per error of its angle.
constexpr double kSteeringGain_1ps = 15.0;

base::EmulatedWheelParams motorOf(const DrivenParams& params, const kinematics::WheelLimits& limits,
                                  bool steered) {
  base::EmulatedWheelParams motor;
  motor.steered = steered;
  motor.full_speed_m_per_s = 1.0;  // the "duty" is the speed that is wanted
  motor.friction_duty = 0.0;
  motor.lag_s = params.lag_s;
  motor.max_acceleration_m_per_s2 = params.max_acceleration_mps2;
  motor.steering_rate_rad_per_s = limits.max_steering_rate_rad_per_s;
  motor.steering_lag_s = params.steering_lag_s;
  return motor;
}

}  // namespace

DrivenBase::DrivenBase(const DrivenParams& params, const WheelModelParams& wheels, const DrivenRig& rig,
                       std::uint64_t seed)
    : params_(params),
      rig_(rig),
      slip_sigma_m_(wheels.slip_sigma_m),
      true_drive_(trueDrive(wheels, rig.drive, seed)),
      commander_(rig.drive, rig.limits),
      slip_(streamKey(seed, Stream::kWheelSlip)),
      slipped_m_(rig.drive.wheels.size(), 0.0),
      targets_(rig.drive.wheels.size()) {
  for (std::size_t i = 0; i < targets_.size(); ++i)
    wheels_.emplace_back(motorOf(params_, rig_.limits, true_drive_.steered(i)));
}

void DrivenBase::command(const kinematics::Twist& twist) {
  wanted_ = twist;
  wanted_s_ = time_s_;
}

void DrivenBase::commandWheels() {
  std::vector<double> steering_rad;
  for (const auto& wheel : wheels_) steering_rad.push_back(wheel.steering_rad());
  if (time_s_ - wanted_s_ > rig_.cmd_vel_timeout_s) wanted_.setZero();
  pending_.emplace_back(time_s_ + params_.dead_time_s,
                        commander_.command(wanted_, 1.0 / rig_.command_rate_hz, steering_rad));
}

/// The controller counts turns by the nominal radius: wheels of another one go faster or slower.
void DrivenBase::followCommands(double duration_s) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const double true_share = trueWheels().wheels[i].radius_m / rig_.drive.wheels[i].radius_m;
    const double rate = kSteeringGain_1ps * (targets_[i].steering_rad - wheels_[i].steering_rad()) /
                        rig_.limits.max_steering_rate_rad_per_s;
    wheels_[i].advance(true_share * targets_[i].speed_m_per_s, std::clamp(rate, -1.0, 1.0), duration_s);
  }
}

kinematics::Twist DrivenBase::step(double duration_s) {
  constexpr double kTiny_s = 1e-9;
  for (; static_cast<double>(commands_) / rig_.command_rate_hz <= time_s_ + kTiny_s; ++commands_)
    commandWheels();
  for (; !pending_.empty() && pending_.front().first <= time_s_ + kTiny_s; pending_.pop_front())
    targets_ = pending_.front().second;
  const std::vector<base::EmulatedWheel> before = wheels_;
  followCommands(duration_s);
  Wheels moved;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const double way_m = wheels_[i].way_m() - before[i].way_m();
    slipped_m_[i] += slip_sigma_m_ * std::sqrt(std::abs(way_m)) * slip_.normal();
    moved.push_back({way_m / duration_s, 0.5 * (before[i].steering_rad() + wheels_[i].steering_rad())});
  }
  time_s_ += duration_s;
  return true_drive_.forward(moved).twist;
}

SimulatedTicks DrivenBase::ticks() const {
  SimulatedTicks ticks{time_s_, {}, {}};
  bool steered = false;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    ticks.pulses.push_back(
        std::llround((wheels_[i].way_m() + slipped_m_[i]) / trueWheels().wheels[i].metresPerPulse()));
    ticks.steering_rad.push_back(wheels_[i].steering_rad());
    steered = steered || true_drive_.steered(i);
  }
  if (!steered) ticks.steering_rad.clear();
  return ticks;
}

}  // namespace stereo_nav::sim
