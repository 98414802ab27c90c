#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "sensors/imu/angular_rate.h"
#include "sensors/imu/imu_device.h"
#include "stereo_nav/sensors/imu/attitude_filter.h"
#include "stereo_nav/sensors/imu/calibration.h"

namespace stereo_nav::imu {

/// What is known after a reading. What the module does not deliver (yet) is absent. IMU frame, front-left-up.
struct ImuEstimate {
  std::optional<Eigen::Quaterniond> q_world_imu;
  std::optional<Eigen::Vector3d> angular_velocity;     ///< rad/s
  std::optional<Eigen::Vector3d> linear_acceleration;  ///< m/s^2, gravity included
};

/// Computes orientation and rates from the readings of either kind of module: from angles by the thesis'
/// convention and differentiation, from raw measurements by calibration and an attitude filter.
class ImuEstimator {
 public:
  ImuEstimator(const AttitudeParams& attitude, const ImuCalibration& calibration, double rate_window_s);

  ImuEstimate process(const ImuReading& reading);

  /// Makes the present heading zero.
  void resetYaw();
  /// Replaces the gyroscope's bias (rad/s, of the raw measurements). A bias that the filter had found is
  /// discarded.
  void setGyroBias(const Eigen::Vector3d& bias);
  const ImuCalibration& calibration() const { return calibration_; }

 private:
  ImuEstimate fromAngles(const ModuleAngles& angles, double time_s);
  ImuEstimate fromRaw(const RawMeasurement& measured, double time_s);

  ImuCalibration calibration_;
  std::unique_ptr<AttitudeFilter> filter_;
  AngularRate rate_;
  double yaw_offset_rad_ = 0.0;
  double last_heading_rad_ = 0.0;
};

}  // namespace stereo_nav::imu
