#include "core/rotation_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stereo_nav/core/lie.h"

namespace stereo_nav {
namespace {

bool isUsable(const ImuSample& sample) {
  return std::isfinite(sample.time_s) && sample.isFinite() &&
         (!sample.q_world_imu || sample.q_world_imu->norm() > 0.5);
}

bool earlier(const ImuSample& sample, double time_s) {
  return sample.time_s < time_s;
}

}  // namespace

bool RotationHistory::add(const ImuSample& sample) {
  if (!isUsable(sample)) return false;
  if (!samples_.empty() && sample.time_s <= samples_.back().time_s) return false;
  samples_.push_back(sample);
  if (samples_.back().q_world_imu) samples_.back().q_world_imu->normalize();
  while (samples_.front().time_s < sample.time_s - history_s_) samples_.pop_front();
  return true;
}

double RotationHistory::newest_s() const {
  return samples_.empty() ? -std::numeric_limits<double>::infinity() : samples_.back().time_s;
}

bool RotationHistory::covers(double from_s, double to_s) const {
  if (samples_.empty() || from_s < samples_.front().time_s || to_s > samples_.back().time_s) return false;
  auto next = std::lower_bound(samples_.begin(), samples_.end(), from_s, earlier);
  if (next != samples_.begin() && next->time_s > from_s) --next;
  for (; next->time_s < to_s; ++next) {
    if (std::next(next)->time_s - next->time_s > kMaxGap_s) return false;
  }
  return true;
}

std::optional<Eigen::Matrix3d> RotationHistory::increment(double from_s, double to_s,
                                                          const Eigen::Matrix3d& R_camera_imu) const {
  const auto R_current_previous_imu = increment(from_s, to_s);
  if (!R_current_previous_imu) return std::nullopt;
  return Eigen::Matrix3d(R_camera_imu * *R_current_previous_imu * R_camera_imu.transpose());
}

std::optional<Eigen::Quaterniond> RotationHistory::attitude(double time_s) const {
  if (!covers(time_s, time_s)) return std::nullopt;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), time_s, earlier);
  if (!after->q_world_imu) return std::nullopt;
  if (after->time_s == time_s) return after->q_world_imu;
  const auto before = std::prev(after);
  if (!before->q_world_imu) return std::nullopt;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return before->q_world_imu->slerp(share, *after->q_world_imu);
}

std::optional<Eigen::Vector3d> RotationHistory::angularVelocity(double time_s) const {
  if (!covers(time_s, time_s)) return std::nullopt;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), time_s, earlier);
  if (!after->angular_velocity) return std::nullopt;
  if (after->time_s == time_s) return after->angular_velocity;
  const auto before = std::prev(after);
  if (!before->angular_velocity) return std::nullopt;
  const double share = (time_s - before->time_s) / (after->time_s - before->time_s);
  return Eigen::Vector3d((1.0 - share) * *before->angular_velocity + share * *after->angular_velocity);
}

std::optional<Eigen::Matrix3d> RotationHistory::increment(double from_s, double to_s) const {
  if (from_s > to_s) {
    const auto backwards = increment(to_s, from_s);
    if (!backwards) return std::nullopt;
    return Eigen::Matrix3d(backwards->transpose());
  }
  if (!covers(from_s, to_s)) return std::nullopt;
  const auto q_world_from = attitude(from_s);
  const auto q_world_to = attitude(to_s);
  if (q_world_from && q_world_to) return (q_world_to->conjugate() * *q_world_from).toRotationMatrix();
  return integrateRates(from_s, to_s);
}

std::optional<Eigen::Matrix3d> RotationHistory::integrateRates(double from_s, double to_s) const {
  std::optional<Eigen::Vector3d> rate = angularVelocity(from_s);
  if (!rate) return std::nullopt;
  Eigen::Matrix3d R_from_now = Eigen::Matrix3d::Identity();
  double now_s = from_s;
  auto next = std::upper_bound(samples_.begin(), samples_.end(), from_s,
                               [](double time_s, const ImuSample& sample) { return time_s < sample.time_s; });
  while (now_s < to_s) {
    const double then_s = next == samples_.end() ? to_s : std::min(to_s, next->time_s);
    const auto next_rate = angularVelocity(then_s);
    if (!next_rate) return std::nullopt;
    // The rate is linear between samples: its mean over the step is that of both ends.
    R_from_now = R_from_now * expRotation(0.5 * (*rate + *next_rate) * (then_s - now_s));
    rate = next_rate;
    now_s = then_s;
    if (next != samples_.end()) ++next;
  }
  return Eigen::Matrix3d(R_from_now.transpose());
}

std::optional<Eigen::Vector3d> RotationHistory::meanAcceleration(double from_s, double to_s) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const ImuSample& sample : samples_) {
    if (sample.time_s < from_s || sample.time_s > to_s || !sample.linear_acceleration) continue;
    sum += *sample.linear_acceleration;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Eigen::Vector3d(sum / count);
}

}  // namespace stereo_nav
