#include "odometry/wheel/interval_motion.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::odometry {

double meanSteering_rad(double from_rad, double to_rad) {
  return from_rad + 0.5 * wrapRadians(to_rad - from_rad);
}

IntervalMotion solveInterval(const kinematics::Drive& drive, const WheelInterval& interval) {
  const std::size_t count = drive.size();
  std::array<kinematics::WheelRows, kMostWheels> rows;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d sideways_information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  IntervalMotion result;
  result.gain.setZero(3, static_cast<Eigen::Index>(count));
  int equations = 0;
  for (std::size_t i = 0; i < count; ++i) {
    rows[i] = drive.rows(i, interval.steering_rad.empty() ? 0.0 : interval.steering_rad[i]);
    const double weight = 1.0 / interval.variance_m2[i];
    if (weight == 0.0) continue;
    const Eigen::Vector3d weighted = weight * rows[i].rolling.transpose();
    information += weighted * rows[i].rolling;
    right += weighted * interval.distance_m[i];
    result.gain.col(static_cast<Eigen::Index>(i)) = weighted;
    ++equations;
    if (!rows[i].has_sideways) continue;
    sideways_information += weight * rows[i].sideways.transpose() * rows[i].sideways;
    ++equations;
  }
  information += sideways_information;
  if (interval.yaw_rad) {
    const double weight = 1.0 / interval.yaw_variance_rad2;
    information(2, 2) += weight;
    right.z() += weight * *interval.yaw_rad;
    result.yaw_gain.z() = weight;
    ++equations;
  }
  Eigen::Matrix3d covariance;
  bool determined = false;
  const Eigen::Vector3d scale = information.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  scaled.computeInverseWithCheck(covariance, determined, 1e-12);
  if (!determined) {
    result.gain.setZero();
    result.yaw_gain.setZero();
    return result;
  }
  covariance = scale.asDiagonal() * covariance * scale.asDiagonal();
  result.motion = covariance * right;
  result.gain = (covariance * result.gain).eval();
  result.yaw_gain = (covariance * result.yaw_gain).eval();
  result.sideways_covariance = covariance * sideways_information * covariance;
  result.redundancy = equations - 3;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = 1.0 / interval.variance_m2[i];
    const double rolling = interval.distance_m[i] - rows[i].rolling * result.motion;
    const double sideways = rows[i].has_sideways ? double(rows[i].sideways * result.motion) : 0.0;
    result.squared_residual += weight * (rolling * rolling + sideways * sideways);
  }
  if (interval.yaw_rad) {
    const double turned = *interval.yaw_rad - result.motion.z();
    result.squared_residual += turned * turned / interval.yaw_variance_rad2;
  }
  return result;
}

}  // namespace stereo_nav::odometry
