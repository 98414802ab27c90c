#include "nodes/wheel_odometry/wheel_session.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "odometry/wheel/pulse_counter.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::size_t kMostWaiting = 100;
constexpr double kFastest_m_per_s = 20.0;  // a wheel that is faster has not turned: its counter jumped
constexpr double kSetBack_s = 1.0;         // a stamp that is older by more is no late message
constexpr double kImuHeard_s = 1.0;        // an IMU whose newest sample is older is not waited for

}  // namespace

WheelSession::WheelSession(const odometry::WheelOdometryParams& params, double imu_wait_s)
    : params_(params),
      imu_wait_s_(imu_wait_s),
      odometry_(std::make_unique<odometry::WheelOdometry>(params)) {}

void WheelSession::addSample(odometry::WheelSample sample, double now_s) {
  waiting_.push_back({std::move(sample), now_s});
}

void WheelSession::addImu(const ImuSample& sample) {
  if (yaw_ && sample.isFinite()) yaw_->add(sample);
}

bool WheelSession::due(const Waiting& waiting, double now_s) const {
  if (!yaw_ || waiting_.size() > kMostWaiting || now_s >= waiting.arrival_s + imu_wait_s_) return true;
  const double ahead_s = yaw_->newest_s() - waiting.sample.time_s;
  return ahead_s >= 0.0 || ahead_s < -kImuHeard_s;
}

WheelSessionOutput WheelSession::take(double now_s) {
  WheelSessionOutput output;
  while (!waiting_.empty() && due(waiting_.front(), now_s)) {
    odometry::WheelSample sample = std::move(waiting_.front().sample);
    waiting_.pop_front();
    process(std::move(sample), output);
  }
  return output;
}

std::string WheelSession::restartReason(const odometry::WheelSample& sample) const {
  if (!last_) return "";
  const double duration_s = sample.time_s - last_->time_s;
  if (duration_s < -kSetBack_s)
    return fmt::format(
        "the stamps of wheel_ticks went back by {:.1f} s: the clock was set back, or a bag starts again",
        -duration_s);
  for (std::size_t i = 0; duration_s > 0.0 && i < sample.pulses.size(); ++i) {
    const auto pulses = odometry::pulsesBetween(last_->pulses[i], sample.pulses[i], params_.counter_bits);
    const double speed = static_cast<double>(pulses) * params_.drive.wheels[i].metresPerPulse() / duration_s;
    if (std::abs(speed) < kFastest_m_per_s) continue;
    return fmt::format(
        "the counter of {} went from {} to {} in {:.3f} s, which is {:.0f} m/s: its driver was started again, or "
        "counter_bits is wrong",
        params_.drive.wheels[i].name, last_->pulses[i], sample.pulses[i], duration_s, speed);
  }
  return "";
}

void WheelSession::restart() {
  odometry_ = std::make_unique<odometry::WheelOdometry>(params_);
  if (last_result_) odometry_->setPose(last_result_->T_odom_base, last_result_->pose_covariance);
  last_.reset();
}

void WheelSession::process(odometry::WheelSample sample, WheelSessionOutput& output) {
  const std::string reason = restartReason(sample);
  if (!reason.empty()) {
    output.announcements.push_back(reason + ". The odometry goes on from its last pose");
    restart();
  }
  if (last_ && sample.time_s <= last_->time_s) {
    ++dropped_;
    return;
  }
  if (yaw_) {
    sample.yaw_rad = yaw_->at(sample.time_s);
    if (!sample.yaw_rad) ++without_imu_;
  }
  last_result_ = odometry_->process(sample);
  last_ = std::move(sample);
  ++readings_;
  output.results.push_back(*last_result_);
}

void WheelSession::setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  odometry_->setPose(T_odom_base, covariance);
  if (!last_result_) return;
  last_result_->T_odom_base = T_odom_base;
  last_result_->pose_covariance = covariance;
}

}  // namespace stereo_nav::nodes
