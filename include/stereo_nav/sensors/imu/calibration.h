#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/sensors/imu/attitude_filter.h"
#include "stereo_nav/sensors/imu/raw_protocol.h"

namespace stereo_nav::imu {

/// x, y, z as a section of a parameter file.
struct VectorParams {
  Eigen::Vector3d value;
  double limit;
  std::string unit;

  void describe(ParameterVisitor& visitor);
};

/// calibrated = (measured - offset) * scale, per axis; the gyroscope has an offset (its bias) only.
struct ImuCalibration {
  VectorParams gyroscope_bias{Eigen::Vector3d::Zero(), 1.0, "rad/s"};
  VectorParams accelerometer_offset{Eigen::Vector3d::Zero(), 20.0, "m/s^2"};
  VectorParams accelerometer_scale{Eigen::Vector3d::Ones(), 2.0, ""};
  VectorParams magnetometer_offset{Eigen::Vector3d::Zero(), 5000.0, "uT"};
  VectorParams magnetometer_scale{Eigen::Vector3d::Ones(), 100.0, ""};

  void describe(ParameterVisitor& visitor);
  InertialSample apply(const RawMeasurement& measured, double time_s) const;
};

/// Throws ParameterError.
ImuCalibration loadCalibration(const std::string& path);
/// Replaces the file in one step. Throws std::runtime_error.
void saveCalibration(const ImuCalibration& calibration, const std::string& path);

struct GyroCalibrationParams {
  double duration_s = 15.0;
  double max_rate_stddev_rad_s = 0.02;
  double max_acceleration_stddev_m_s2 = 0.3;
  double max_mean_rate_rad_s = 0.2;

  void describe(ParameterVisitor& visitor);
};

/// Mean angular rate at rest. Refuses when the module moved: the spread of the rates or accelerations, the
/// difference between the two halves of the time, or the mean itself is too large.
class GyroCalibrator {
 public:
  explicit GyroCalibrator(const GyroCalibrationParams& params) : params_(params) {}

  void add(double time_s, const Eigen::Vector3d& angular_velocity, const Eigen::Vector3d& acceleration);
  bool complete() const;

  struct Result {
    bool accepted = false;
    Eigen::Vector3d bias = Eigen::Vector3d::Zero();    ///< rad/s
    Eigen::Vector3d stddev = Eigen::Vector3d::Zero();  ///< rad/s, of a single sample
    std::string message;
  };
  Result result() const;

 private:
  GyroCalibrationParams params_;
  std::vector<double> times_s_;
  std::vector<Eigen::Vector3d> rates_, accelerations_;
};

/// Offset and scale per axis that put points on a sphere: |(p - offset) * scale| = radius.
struct SphereFit {
  bool accepted = false;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  double residual_rms = 0.0;  ///< of the magnitude, in the points' unit
  std::string message;
};

/// Fits an axis-aligned ellipsoid, first algebraically (linear least squares), then on the magnitudes
/// (Gauss-Newton). Refuses when the points do not reach at least +-0.7 radius along every axis, or stay
/// farther than 5 % of the radius from the sphere. For an accelerometer turned slowly about each axis the
/// radius is 9.80665 m/s^2.
SphereFit fitSphere(const std::vector<Eigen::Vector3d>& points, double radius);

}  // namespace stereo_nav::imu
