#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "core/planar_motion.h"
#include "kinematics/drive.h"
#include "odometry/wheel/wheel_odometry.h"

namespace stereo_nav::odometry {

/// A base that is moved exactly, and the pulses that its encoders count.
class DrivenWheels {
 public:
  explicit DrivenWheels(const kinematics::DriveParams& params)
      : drive_(params), rolled_m_(params.wheels.size(), 0.0), steering_rad_(params.wheels.size(), 0.0) {}

  /// Moves along the arc of a twist; `slip_m` has a wheel turn further than the base moves.
  void move(const kinematics::Twist& twist, double duration_s, const std::vector<double>& slip_m = {}) {
    const auto wheels = drive_.inverse(twist);
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      rolled_m_[i] += wheels[i].speed_m_per_s * duration_s + (slip_m.empty() ? 0.0 : slip_m[i]);
      steering_rad_[i] = wheels[i].steering_rad;
    }
    T_odom_base_ = T_odom_base_ * expPlanar(drive_.nearestPossible(twist) * duration_s);
    yaw_rad_ += twist.z() * duration_s;
    time_s_ += duration_s;
  }

  /// Moves straight in the odometry's frame while turning, in steps small enough to be exact.
  void moveStraightTurning(double speed_m_per_s, double turn_rad_per_s, double duration_s) {
    const int steps = 50;
    for (int i = 0; i < steps; ++i) {
      const kinematics::Twist wanted = kinematics::fromField({speed_m_per_s, 0.0, turn_rad_per_s}, yaw_rad_);
      move(kinematics::alongArc(wanted, duration_s / steps), duration_s / steps);
    }
  }

  WheelSample sample(bool with_yaw) const {
    WheelSample sample;
    sample.time_s = time_s_;
    bool steered = false;
    for (std::size_t i = 0; i < drive_.size(); ++i) {
      sample.pulses.push_back(std::llround(rolled_m_[i] / drive_.params().wheels[i].metresPerPulse()));
      steered = steered || drive_.steered(i);
    }
    if (steered) sample.steering_rad = steering_rad_;
    if (with_yaw) sample.yaw_rad = std::remainder(yaw_rad_, 2.0 * M_PI);
    return sample;
  }

  const Eigen::Isometry2d& pose() const { return T_odom_base_; }
  const kinematics::Drive& drive() const { return drive_; }

 private:
  kinematics::Drive drive_;
  std::vector<double> rolled_m_;
  std::vector<double> steering_rad_;
  Eigen::Isometry2d T_odom_base_ = Eigen::Isometry2d::Identity();
  double yaw_rad_ = 0.0;
  double time_s_ = 0.0;
};

inline WheelOdometryParams odometryOf(const kinematics::DriveParams& drive) {
  WheelOdometryParams params;
  params.drive = drive;
  return params;
}

/// A course with every motion in it.
inline kinematics::Twist twistAt(double time_s) {
  return {0.6 * std::sin(0.9 * time_s), 0.5 * std::cos(0.7 * time_s), 0.8 * std::sin(0.5 * time_s + 0.4)};
}

}  // namespace stereo_nav::odometry
