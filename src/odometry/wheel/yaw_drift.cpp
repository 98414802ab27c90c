#include "odometry/wheel/yaw_drift.h"

#include <algorithm>
#include <cmath>

#include "odometry/wheel/interval_motion.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kStill_s = 0.5;    // without a pulse: less may be a slow motion between two pulses
constexpr double kMeasure_s = 0.5;  // over which one measurement is taken
constexpr double kMostDrift_rad_per_s = 0.05;  // 3 deg/s; cheap gyroscopes have less
constexpr double kSigmas = 5.0;                // of an increment's noise, beyond which it is no noise
constexpr double kFarOff = 3.0;                // in standard deviations
constexpr double kMemory_s = 600.0;  // after which a drift has changed by as much as was assumed of it

/// Variance of the yaw that the wheels give where no counter changes.
double yawVarianceOfRest(const WheelOdometryParams& params, const kinematics::Drive& drive) {
  WheelInterval rest;
  rest.distance_m.assign(drive.size(), 0.0);
  rest.steering_rad.assign(drive.size(), 0.0);
  for (const auto& wheel : params.drive.wheels)
    rest.variance_m2.push_back(2.0 * params.readingVariance_m2(wheel));
  const IntervalMotion motion = solveInterval(drive, rest);
  double variance = motion.sideways_covariance(2, 2);
  for (std::size_t i = 0; i < drive.size(); ++i)
    variance += rest.variance_m2[i] * std::pow(motion.gain(2, static_cast<Eigen::Index>(i)), 2);
  return variance;
}

}  // namespace

YawDrift::YawDrift(const WheelOdometryParams& params, const kinematics::Drive& drive)
    : prior_variance_(std::pow(params.yaw_drift_sigma_rad_per_s, 2)),
      yaw_variance_per_s_(std::pow(params.yaw_sigma_rad, 2)),
      wheels_variance_(yawVarianceOfRest(params, drive)),
      variance_(prior_variance_) {}

void YawDrift::add(bool wheels_turned, std::optional<double> yaw_rad, double duration_s) {
  variance_ =
      std::min(variance_ + prior_variance_ * duration_s / kMemory_s, std::max(variance_, prior_variance_));
  const double most_rad =
      kMostDrift_rad_per_s * duration_s + kSigmas * std::sqrt(yaw_variance_per_s_ * duration_s);
  const bool by_hand = yaw_rad && std::abs(*yaw_rad) > most_rad;
  still_s_ = wheels_turned || by_hand ? 0.0 : still_s_ + duration_s;
  at_rest_ = still_s_ >= kStill_s;
  if (!at_rest_ || !yaw_rad) {
    rest_yaw_rad_ = rest_s_ = 0.0;
    return;
  }
  rest_yaw_rad_ += *yaw_rad;
  rest_s_ += duration_s;
  if (rest_s_ >= kMeasure_s) measure();
}

void YawDrift::measure() {
  const double noise = (yaw_variance_per_s_ * rest_s_ + wheels_variance_) / (rest_s_ * rest_s_);
  const double off = rest_yaw_rad_ / rest_s_ - rate_rad_per_s_;
  // A drift that is far larger than was assumed is one all the same.
  if (off * off > kFarOff * kFarOff * (variance_ + noise)) variance_ = off * off - noise;
  const double gain = variance_ / (variance_ + noise);
  rate_rad_per_s_ += gain * off;
  variance_ *= 1.0 - gain;
  rest_yaw_rad_ = rest_s_ = 0.0;
}

}  // namespace stereo_nav::odometry
