#include <sstream>

#include "stereo_nav/sensors/imu/calibration.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Vector3d;

struct Spread {
  Vector3d mean;
  Vector3d stddev;
};

Spread spreadOf(const std::vector<Vector3d>& values, std::size_t begin, std::size_t end) {
  const auto count = static_cast<double>(end - begin);
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) mean += values[i] / count;
  Vector3d variance = Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) variance += (values[i] - mean).cwiseAbs2() / count;
  return {mean, variance.cwiseSqrt()};
}

std::string refusal(const std::string& what, double seen, double allowed, const std::string& unit) {
  std::ostringstream text;
  text << "the module moved: " << what << " is " << seen << " " << unit << ", allowed is " << allowed
       << "; keep the robot still, motors off, and try again";
  return text.str();
}

}  // namespace

void GyroCalibrationParams::describe(ParameterVisitor& visitor) {
  visitor.real("duration_s", duration_s, {1.0, 600.0}, "s", "time at rest that is averaged");
  visitor.real("max_rate_stddev_rad_s", max_rate_stddev_rad_s, {1e-5, 1.0}, "rad/s",
               "larger spread of the rates means that the module moved");
  visitor.real("max_acceleration_stddev_m_s2", max_acceleration_stddev_m_s2, {1e-4, 10.0}, "m/s^2",
               "larger spread of the accelerations means that the module moved");
  visitor.real("max_mean_rate_rad_s", max_mean_rate_rad_s, {1e-4, 1.0}, "rad/s",
               "a larger mean is a steady turn, not a bias");
}

void GyroCalibrator::add(double time_s, const Vector3d& angular_velocity, const Vector3d& acceleration) {
  if (complete()) return;
  times_s_.push_back(time_s);
  rates_.push_back(angular_velocity);
  accelerations_.push_back(acceleration);
}

bool GyroCalibrator::complete() const {
  return times_s_.size() > 1 && times_s_.back() - times_s_.front() >= params_.duration_s;
}

GyroCalibrator::Result GyroCalibrator::result() const {
  Result result;
  if (!complete()) {
    result.message =
        "too few measurements: the module's stream ended before the time was over; see the diagnostics";
    return result;
  }
  const std::size_t count = rates_.size();
  const Spread rate = spreadOf(rates_, 0, count);
  const Spread acceleration = spreadOf(accelerations_, 0, count);
  const Vector3d drift = spreadOf(rates_, count / 2, count).mean - spreadOf(rates_, 0, count / 2).mean;
  result.bias = rate.mean;
  result.stddev = rate.stddev;
  const double rate_spread = rate.stddev.maxCoeff();
  const double acceleration_spread = acceleration.stddev.maxCoeff();
  const double half_difference = drift.cwiseAbs().maxCoeff();
  const double mean_rate = rate.mean.cwiseAbs().maxCoeff();
  if (rate_spread > params_.max_rate_stddev_rad_s) {
    result.message = refusal("the spread of the rates", rate_spread, params_.max_rate_stddev_rad_s, "rad/s");
  } else if (acceleration_spread > params_.max_acceleration_stddev_m_s2) {
    result.message = refusal("the spread of the accelerations", acceleration_spread,
                             params_.max_acceleration_stddev_m_s2, "m/s^2");
  } else if (half_difference > 0.5 * params_.max_rate_stddev_rad_s) {
    result.message = refusal("the difference between first and second half", half_difference,
                             0.5 * params_.max_rate_stddev_rad_s, "rad/s");
  } else if (mean_rate > params_.max_mean_rate_rad_s) {
    result.message = refusal("the mean rate", mean_rate, params_.max_mean_rate_rad_s, "rad/s");
  } else {
    result.accepted = true;
    std::ostringstream text;
    text << "gyroscope bias " << rate.mean.transpose() << " rad/s from " << count << " measurements";
    result.message = text.str();
  }
  return result;
}

}  // namespace stereo_nav::imu
