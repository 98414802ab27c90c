#include "odometry/wheel/wheel_odometry.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kSlipMemory_s = 1.0;

/// Difference of two readings of a counter that wraps, taken the short way round.
std::int64_t counted(std::int64_t from, std::int64_t to, int bits) {
  const std::uint64_t period = std::uint64_t{1} << bits;
  const std::uint64_t difference =
      (static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from)) & (period - 1);
  if (difference < period / 2) return static_cast<std::int64_t>(difference);
  return -static_cast<std::int64_t>(period - difference);
}

WheelOdometryParams checked(const WheelOdometryParams& params) {
  validateParameters(params, "wheel odometry");
  return params;
}

}  // namespace

WheelOdometry::WheelOdometry(const WheelOdometryParams& params)
    : params_(checked(params)),
      drive_(params_.drive),
      encoders_(drive_),
      covariance_(drive_.size(), {params_.scale_sigma, params_.yaw_drift_sigma_rad_per_s}),
      slip_variance_m2_(drive_.size(), 0.0) {
  for (const auto& wheel : params_.drive.wheels)
    reading_variance_m2_.push_back(std::pow(params_.pulse_sigma * wheel.metresPerPulse(), 2));
}

void WheelOdometry::setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  const Eigen::Isometry2d T_new_old = T_odom_base * T_odom_base_.inverse();
  for (auto& mark : marks_) mark.T_odom_base = T_new_old * mark.T_odom_base;  // the speed stays what it is
  T_odom_base_ = T_odom_base;
  covariance_.reset(covariance);
}

void WheelOdometry::check(const WheelSample& sample) const {
  const auto counts = [this](const char* what, std::size_t seen) {
    return InputError("a sample holds " + std::to_string(seen) + " " + what + ", the drive has " +
                      std::to_string(drive_.size()) +
                      " wheels; is the section `drive` of the rig file that of this robot?");
  };
  if (sample.pulses.size() != drive_.size()) throw counts("pulse counters", sample.pulses.size());
  bool steered = false;
  for (std::size_t i = 0; i < drive_.size(); ++i) steered = steered || drive_.steered(i);
  if (steered && sample.steering_rad.size() != drive_.size())
    throw counts("steering angles", sample.steering_rad.size());
  if (last_ && !(sample.time_s > last_->time_s)) {
    throw InputError("the stamp " + std::to_string(sample.time_s) +
                     " s of the wheels is not later than the last one, " + std::to_string(last_->time_s) +
                     " s; samples must come in order of time, each once");
  }
}

WheelInterval WheelOdometry::intervalTo(const WheelSample& sample) {
  const double duration_s = sample.time_s - last_->time_s;
  WheelInterval interval;
  interval.distance_m.resize(drive_.size());
  interval.variance_m2.resize(drive_.size());
  for (std::size_t i = 0; i < drive_.size(); ++i) {
    const auto pulses = counted(last_->pulses[i], sample.pulses[i], params_.counter_bits);
    interval.distance_m[i] = static_cast<double>(pulses) * params_.drive.wheels[i].metresPerPulse();
    slip_variance_m2_[i] =
        slip_factor_ * params_.slip_sigma_m * params_.slip_sigma_m * std::abs(interval.distance_m[i]);
    interval.variance_m2[i] = slip_variance_m2_[i] + 2.0 * reading_variance_m2_[i];
  }
  if (!sample.steering_rad.empty()) {
    interval.steering_rad.resize(drive_.size());
    for (std::size_t i = 0; i < drive_.size(); ++i) {
      const double from = last_->steering_rad[i];
      interval.steering_rad[i] = from + 0.5 * wrapRadians(sample.steering_rad[i] - from);
    }
  }
  if (sample.yaw_rad && last_->yaw_rad) interval.yaw_rad = wrapRadians(*sample.yaw_rad - *last_->yaw_rad);
  interval.yaw_variance_rad2 = params_.yaw_sigma_rad * params_.yaw_sigma_rad * duration_s;
  return interval;
}

void WheelOdometry::compose(const IntervalMotion& motion) {
  if (params_.as_published) {
    T_odom_base_.pretranslate(T_odom_base_.linear() * motion.motion.head<2>());
    T_odom_base_.rotate(motion.motion.z());
    return;
  }
  T_odom_base_ = T_odom_base_ * expPlanar(motion.motion);
}

WheelOdometryResult WheelOdometry::process(const WheelSample& sample) {
  check(sample);
  if (last_) {
    const double duration_s = sample.time_s - last_->time_s;
    const WheelInterval interval = intervalTo(sample);
    const IntervalMotion motion = solveInterval(drive_, interval);
    covariance_.append(interval, motion, duration_s, slip_variance_m2_, reading_variance_m2_);
    compose(motion);
    if (motion.redundancy > 0) {
      const double seen = slip_factor_ * motion.squared_residual / motion.redundancy;
      contradiction_ += std::min(1.0, duration_s / kSlipMemory_s) * (seen - contradiction_);
      slip_factor_ = std::max(1.0, contradiction_);
    }
    encoders_.add(interval, duration_s);
  }
  last_ = sample;
  return resultAt(sample.time_s);
}

WheelOdometryResult WheelOdometry::resultAt(double time_s) {
  marks_.push_back({time_s, T_odom_base_});
  while (marks_.size() > 2 && marks_[1].time_s <= time_s - params_.speed_window_s + 1e-9) marks_.pop_front();
  WheelOdometryResult result;
  result.time_s = time_s;
  result.T_odom_base = T_odom_base_;
  result.pose_covariance = covariance_.covariance();
  result.slip = std::sqrt(slip_factor_);
  result.problem = encoders_.finding();
  if (marks_.size() > 1) {
    const double window_s = time_s - marks_.front().time_s;
    result.twist = logPlanar(marks_.front().T_odom_base.inverse() * T_odom_base_) / window_s;
  }
  return result;
}

}  // namespace stereo_nav::odometry
