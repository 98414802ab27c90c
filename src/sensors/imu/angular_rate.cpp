#include "sensors/imu/angular_rate.h"

#include "stereo_nav/core/lie.h"

namespace stereo_nav::imu {

std::optional<Eigen::Vector3d> AngularRate::update(double time_s, const Eigen::Quaterniond& q_world_imu) {
  if (!history_.empty() &&
      (time_s <= history_.back().time_s || time_s - history_.back().time_s > kMaxGap_s)) {
    history_.clear();
  }
  history_.push_back({time_s, q_world_imu});
  while (history_.size() > 2 && time_s - history_[1].time_s >= window_s_) history_.pop_front();
  if (history_.size() < 2) return std::nullopt;
  const Entry& first = history_.front();
  return Eigen::Vector3d(logRotation(first.q_world_imu.conjugate() * q_world_imu) / (time_s - first.time_s));
}

}  // namespace stereo_nav::imu
