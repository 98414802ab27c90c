#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <vector>

#include "core/rotation_history.h"

namespace stereo_nav::odometry {

/// What measures the rates of an axis of the base.
enum class RateSource { kNone, kWheels, kGyro };

/// A short time in which the rates are taken as constant.
struct RatePiece {
  double duration_s = 0.0;
  Eigen::Vector3d rate =
      Eigen::Vector3d::Zero();  ///< forward m/s, left m/s, rad/s; 0 where nothing measures it
};

/// The rates over an interval.
struct MeasuredMotion {
  std::vector<RatePiece> pieces;
  RateSource translation = RateSource::kNone;  ///< kWheels or kNone
  RateSource rotation = RateSource::kNone;
};

/// Wheels and gyroscope of the last seconds. Samples must come in order of time; others are left out.
class MotionInputs {
 public:
  /// Pose of the base by its wheels, in any fixed frame. A jump begins a new one.
  void addWheels(double time_s, const Eigen::Isometry2d& T_wheels_base);
  /// Only its angular rate counts; an attitude stands in where the IMU gives no rates: magnetic fields bend a
  /// yaw, a gyroscope does not feel them.
  void addImu(const ImuSample& sample, const Eigen::Matrix3d& R_base_imu);
  /// Forgets the wheels, and the gyroscope, whose newest sample is later: their clock has been set back
  /// since.
  void forgetNewerThan(double time_s);

  double newestWheels_s() const;
  double newestImu_s() const { return gyro_.newest_s(); }

  /// The rates between two instants, in pieces. A source that does not cover all of it is not used.
  MeasuredMotion between(double from_s, double to_s) const;

 private:
  struct WheelPose {
    double time_s;
    Eigen::Isometry2d T_wheels_base;
  };
  static bool jumps(const WheelPose& from, const WheelPose& to);
  std::optional<Eigen::Isometry2d> wheelsAt(double time_s) const;

  std::deque<WheelPose> wheels_;
  RotationHistory gyro_;
  Eigen::Matrix3d R_base_imu_ = Eigen::Matrix3d::Identity();
};

}  // namespace stereo_nav::odometry
