#include "nodes/laser_odometry/laser_session.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::size_t kMostScans = 20;
constexpr double kSetBack_s = 1.0;  // a stamp that is older by more is no late message
constexpr double kHeard_s = 1.0;    // wheels or an IMU whose newest sample is older are not waited for

}  // namespace

LaserSession::LaserSession(const odometry::LaserParams& params, double prior_wait_s)
    : params_(params),
      prior_wait_s_(prior_wait_s),
      odometry_(std::make_unique<odometry::LaserOdometry>(params)) {}

void LaserSession::addScan(odometry::LaserScan scan, std::int64_t stamp_ns, double now_s) {
  ++counts_.received;
  newest_scan_s_ = scan.time_s;
  waiting_.push_back({std::move(scan), stamp_ns, now_s});
  if (T_base_laser_ || waiting_.size() <= kMostScans) return;
  waiting_.pop_front();
  ++counts_.dropped;
}

void LaserSession::addWheels(double time_s, const Eigen::Isometry2d& T_wheels_base) {
  newest_wheels_s_ = time_s;
  odometry_->inputs().addWheels(time_s, T_wheels_base);
}

void LaserSession::addImu(const ImuSample& sample, const Eigen::Matrix3d& R_base_imu) {
  if (!sample.isFinite()) return;
  newest_imu_s_ = sample.time_s;
  odometry_->inputs().addImu(sample, R_base_imu);
}

std::optional<double> LaserSession::ahead_s(const std::optional<double>& newest_s) const {
  if (!newest_s || !newest_scan_s_) return std::nullopt;
  return *newest_s - *newest_scan_s_;
}

bool LaserSession::covered(const odometry::LaserScan& scan) const {
  const double end_s = scan.time_s + scan.sweep_s();
  for (const auto& newest_s : {newest_wheels_s_, newest_imu_s_}) {
    if (!newest_s) continue;
    const double missing_s = end_s - *newest_s;
    if (missing_s > 0.0 && missing_s < kHeard_s) return false;
  }
  return true;
}

bool LaserSession::due(const Waiting& waiting, double now_s) const {
  if (!T_base_laser_) return false;
  return waiting_.size() > kMostScans || now_s >= waiting.arrival_s + prior_wait_s_ || covered(waiting.scan);
}

LaserSessionOutput LaserSession::take(double now_s) {
  LaserSessionOutput output;
  while (!waiting_.empty() && due(waiting_.front(), now_s)) {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    if (!covered(next.scan)) ++counts_.without_prior;
    process(next, output);
  }
  return output;
}

/// Wheels and IMU may have come with the new clock before a scan did: those that are nearer to this scan than
/// to the last one are kept.
void LaserSession::restart(double scan_s) {
  const double between_s = 0.5 * (last_->time_s + scan_s);
  odometry::MotionInputs inputs = std::move(odometry_->inputs());
  inputs.forgetNewerThan(between_s);
  odometry_ = std::make_unique<odometry::LaserOdometry>(params_);
  odometry_->inputs() = std::move(inputs);
  odometry_->setPose(last_->T_odom_base, last_->pose_covariance);
  for (std::optional<double>* newest_s : {&newest_wheels_s_, &newest_imu_s_})
    if (*newest_s && **newest_s > between_s) newest_s->reset();
  last_.reset();
}

void LaserSession::process(const Waiting& waiting, LaserSessionOutput& output) {
  const odometry::LaserScan& scan = waiting.scan;
  if (last_ && scan.time_s < last_->time_s - kSetBack_s) {
    output.announcements.push_back(fmt::format(
        "the stamps of the scans went back by {:.1f} s: the clock was set back, or a bag starts again. The "
        "odometry goes on from its last pose",
        last_->time_s - scan.time_s));
    restart(scan.time_s);
  }
  if (last_ && scan.time_s <= last_->time_s) {
    ++counts_.dropped;
    return;
  }
  try {
    LaserReading reading;
    reading.stamp_ns = waiting.stamp_ns;
    reading.result = odometry_->process(scan, *T_base_laser_);
    reading.beams = scan.ranges_m.size();
    last_ = reading.result;
    using State = odometry::LaserOdometryResult::State;
    if (last_->state == State::kPartly) ++counts_.partly;
    if (last_->state == State::kCoasting) ++counts_.coasting;
    output.readings.push_back(std::move(reading));
    output.error.clear();
  } catch (const InputError& error) {
    ++counts_.dropped;
    output.error = error.what();
  }
}

void LaserSession::reset() {
  setPose(Eigen::Isometry2d::Identity(), Eigen::Matrix3d::Zero());
}

void LaserSession::setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  odometry_->setPose(T_odom_base, covariance);
  if (!last_) return;
  last_->T_odom_base = T_odom_base;
  last_->pose_covariance = covariance;
}

}  // namespace stereo_nav::nodes
