#include "odometry/wheel/imu_yaw.h"

namespace stereo_nav::odometry {

std::optional<double> ImuYaw::at(double time_s) {
  const std::optional<double> from_s = last_s_;
  last_s_ = time_s;
  if (!from_s) return yaw_rad_;
  const auto R_now_before = history_.increment(*from_s, time_s, R_base_imu_);
  if (!R_now_before) return std::nullopt;
  const Eigen::AngleAxisd turn(R_now_before->transpose());
  yaw_rad_ += turn.angle() * turn.axis().z();
  return yaw_rad_;
}

}  // namespace stereo_nav::odometry
