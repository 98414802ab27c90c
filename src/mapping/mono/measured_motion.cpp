#include "mapping/mono/measured_motion.h"

namespace stereo_nav::mapping {

std::optional<MeasuredTurn> turnBetween(const RotationHistory& imu, double from_s, double to_s,
                                        const Eigen::Matrix3d& R_camera_imu,
                                        const MeasuredMotionParams& params) {
  const auto R_now_before = imu.increment(from_s, to_s, R_camera_imu);
  if (!R_now_before || !(to_s > from_s)) return std::nullopt;
  return MeasuredTurn{-logRotation(*R_now_before) / (to_s - from_s), params.gyro_sigma_rad_per_s};
}

MeasuredVelocity velocityOf(const Eigen::Isometry3d& T_before_now, double duration_s,
                            const MeasuredMotionParams& params) {
  const Eigen::Vector3d v_camera =
      T_before_now.linear().transpose() * T_before_now.translation() / duration_s;
  const double sigma = params.speed_sigma_m_per_s + params.speed_sigma_share * v_camera.norm();
  return {v_camera, sigma * sigma * Eigen::Matrix3d::Identity()};
}

}  // namespace stereo_nav::mapping
