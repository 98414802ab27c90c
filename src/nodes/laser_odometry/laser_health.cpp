#include "nodes/laser_odometry/laser_health.h"

#include <ros/console.h>

#include <chrono>

namespace stereo_nav::nodes {
namespace {

constexpr double kRepeatProblem_s = 10.0;
using State = odometry::LaserOdometryResult::State;

double steadyClock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string priorOf(const odometry::LaserOdometryResult& result) {
  if (result.wheels) return result.gyroscope ? "wheels and gyroscope" : "wheels";
  return result.gyroscope ? "gyroscope, last velocity" : "last velocity";
}

/// What the scan does not tell is no defect while wheels tell it.
bool isGuess(const odometry::LaserOdometryResult& result) {
  return result.state == State::kCoasting || (result.state == State::kPartly && !result.wheels);
}

}  // namespace

LaserHealth::LaserHealth(ros::NodeHandle& handle, ros::NodeHandle& private_handle, const std::string& name)
    : name_(name), problems_(kRepeatProblem_s), updater_(handle, private_handle, name) {
  updater_.setHardwareID("none");
  updater_.add("laser odometry", this, &LaserHealth::fillStatus);
}

void LaserHealth::set(const std::string& key, bool is_error, const std::string& text) {
  if (text.empty()) {
    if (problems_.clear(key)) ROS_INFO_STREAM(name_ << ": over: " << key);
    return;
  }
  if (!problems_.raise(key, is_error, text, steadyClock_s())) return;
  if (is_error) {
    ROS_ERROR_STREAM(name_ << ": " << text);
  } else {
    ROS_WARN_STREAM(name_ << ": " << text);
  }
}

void LaserHealth::publish(const ScanCounts& counts) {
  counts_ = counts;
  updater_.force_update();
}

void LaserHealth::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (!last_) {
    status.summary(Level::OK, "waiting for scans");
  } else if (isGuess(last_->result)) {
    status.summary(Level::WARN, last_->result.reason + "; the " + priorOf(last_->result) + " goes on");
  } else {
    status.summary(Level::OK, last_->result.reason.empty() ? "tracking" : last_->result.reason);
  }
  for (const auto& problem : problems_.all())
    status.mergeSummary(problem.second.is_error ? Level::ERROR : Level::WARN, problem.second.text);
  status.add("scans", counts_.received);
  status.add("scans dropped (late, repeated, before the mounting was known)", counts_.dropped);
  status.add("scans that do not tell all of the motion", counts_.partly);
  status.add("scans that tell nothing", counts_.coasting);
  status.add("scans whose wheels or IMU came too late", counts_.without_prior);
  if (!last_) return;
  const odometry::LaserOdometryResult& result = last_->result;
  status.add("prior", priorOf(result));
  status.addf("points on the map, of beams", "%.0f %% of %zu, %zu", 100.0 * result.inlier_share,
              result.points, last_->beams);
  status.addf("least told share, residuals", "%.3f, %.2f", result.least_share, result.residual_scale);
  status.addf("speed [m/s], turning [rad/s]", "%.3f, %.3f", result.twist.head<2>().norm(), result.twist.z());
}

}  // namespace stereo_nav::nodes
