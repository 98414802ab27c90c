#include "odometry/wheel/wheel_odometry.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "odometry/wheel/pulse_counter.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kSlipMemory_s = 1.0;

WheelOdometryParams checked(const WheelOdometryParams& params) {
  validateParameters(params, "wheel odometry");
  validateParameters(params.drive, "drive");
  return params;
}

}  // namespace

WheelOdometry::WheelOdometry(const WheelOdometryParams& params)
    : params_(checked(params)),
      drive_(params_.drive),
      encoders_(drive_),
      covariance_(drive_.size(), params_.scale_sigma),
      yaw_drift_(params_, drive_) {
  step_.slip_variance_m2.assign(drive_.size(), 0.0);
  for (const auto& wheel : params_.drive.wheels)
    reading_variance_m2_.push_back(params_.readingVariance_m2(wheel));
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

void WheelOdometry::measureInterval(const WheelSample& sample) {
  WheelInterval& interval = step_.interval;
  step_.duration_s = sample.time_s - last_->time_s;
  interval.distance_m.resize(drive_.size());
  interval.variance_m2.resize(drive_.size());
  for (std::size_t i = 0; i < drive_.size(); ++i) {
    const auto pulses = pulsesBetween(last_->pulses[i], sample.pulses[i], params_.counter_bits);
    interval.distance_m[i] = static_cast<double>(pulses) * params_.drive.wheels[i].metresPerPulse();
    step_.slip_variance_m2[i] = slip_factor_ * params_.slipVariance_m2(interval.distance_m[i]);
    interval.variance_m2[i] = step_.slip_variance_m2[i] + 2.0 * reading_variance_m2_[i];
  }
  interval.steering_rad.resize(sample.steering_rad.size());
  for (std::size_t i = 0; i < sample.steering_rad.size(); ++i)
    interval.steering_rad[i] = meanSteering_rad(last_->steering_rad[i], sample.steering_rad[i]);
  takeYaw(sample);
}

/// After the distances. Freed from the drift; left out at rest, where the wheels know better.
void WheelOdometry::takeYaw(const WheelSample& sample) {
  WheelInterval& interval = step_.interval;
  interval.yaw_rad.reset();
  interval.yaw_variance_rad2 = params_.yaw_sigma_rad * params_.yaw_sigma_rad * step_.duration_s;
  if (sample.yaw_rad && last_->yaw_rad) interval.yaw_rad = wrapRadians(*sample.yaw_rad - *last_->yaw_rad);
  const bool turned = std::any_of(interval.distance_m.begin(), interval.distance_m.end(),
                                  [](double distance_m) { return distance_m != 0.0; });
  yaw_drift_.add(turned, interval.yaw_rad, step_.duration_s);
  step_.yaw_drift_variance = yaw_drift_.variance();
  if (yaw_drift_.atRest()) interval.yaw_rad.reset();
  if (interval.yaw_rad) *interval.yaw_rad -= yaw_drift_.rate_rad_per_s() * step_.duration_s;
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
    measureInterval(sample);
    step_.motion = solveInterval(drive_, step_.interval);
    const IntervalMotion& motion = step_.motion;
    covariance_.append(step_, reading_variance_m2_);
    compose(motion);
    if (motion.redundancy > 0) {
      const double seen = slip_factor_ * motion.squared_residual / motion.redundancy;
      contradiction_ += std::min(1.0, step_.duration_s / kSlipMemory_s) * (seen - contradiction_);
      slip_factor_ = std::max(1.0, contradiction_);
    }
    encoders_.add(step_.interval, step_.duration_s);
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
  result.yaw_drift_rad_per_s = yaw_drift_.rate_rad_per_s();
  result.problem = encoders_.finding();
  if (marks_.size() > 1) {
    const double window_s = time_s - marks_.front().time_s;
    result.twist = logPlanar(marks_.front().T_odom_base.inverse() * T_odom_base_) / window_s;
    result.twist_covariance = twistCovariance(window_s);
  }
  return result;
}

/// As if all of the window were like its last interval.
Eigen::Matrix3d WheelOdometry::twistCovariance(double window_s) const {
  const double intervals = window_s / step_.duration_s;
  const IntervalMotion& motion = step_.motion;
  Eigen::Matrix3d covariance = intervals * motion.sideways_covariance;
  for (Eigen::Index i = 0; i < motion.gain.cols(); ++i) {
    const auto wheel = static_cast<std::size_t>(i);
    const double scale_error_m = params_.scale_sigma * intervals * step_.interval.distance_m[wheel];
    const double variance_m2 = intervals * step_.slip_variance_m2[wheel] + 2.0 * reading_variance_m2_[wheel] +
                               scale_error_m * scale_error_m;
    covariance += variance_m2 * motion.gain.col(i) * motion.gain.col(i).transpose();
  }
  if (step_.interval.yaw_rad)
    covariance +=
        intervals * step_.interval.yaw_variance_rad2 * motion.yaw_gain * motion.yaw_gain.transpose();
  return covariance / (window_s * window_s);
}

}  // namespace stereo_nav::odometry
