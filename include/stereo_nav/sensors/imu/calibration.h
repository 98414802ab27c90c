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
  Eigen::Vector3d value;  ///< x, y, z
  double limit;           ///< largest magnitude of a component that a file may hold
  std::string unit;       ///< for the documentation

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// calibrated = (measured - offset) * scale, per axis; the gyroscope has an offset (its bias) only.
struct ImuCalibration {
  VectorParams gyroscope_bias{Eigen::Vector3d::Zero(), 1.0, "rad/s"};  ///< rate that is measured at rest
  VectorParams accelerometer_offset{Eigen::Vector3d::Zero(), 20.0, "m/s^2"};  ///< subtracted first
  VectorParams accelerometer_scale{Eigen::Vector3d::Ones(), 2.0, ""};         ///< factor per axis
  VectorParams magnetometer_offset{Eigen::Vector3d::Zero(), 5000.0, "uT"};    ///< subtracted first
  VectorParams magnetometer_scale{Eigen::Vector3d::Ones(), 100.0, ""};        ///< factor per axis

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
  /// The measurement with the calibration applied, taken at `time_s`.
  InertialSample apply(const RawMeasurement& measured, double time_s) const;
};

/// Throws ParameterError.
ImuCalibration loadCalibration(const std::string& path);
/// Replaces the file atomically. Throws std::runtime_error.
void saveCalibration(const ImuCalibration& calibration, const std::string& path);

/// How long the module must rest, and what counts as rest.
struct GyroCalibrationParams {
  double duration_s = 15.0;                   ///< how long the module must rest
  double max_rate_stddev_rad_s = 0.02;        ///< largest spread of the rates at rest
  double max_acceleration_stddev_m_s2 = 0.3;  ///< largest spread of the accelerations at rest
  double max_mean_rate_rad_s = 0.2;           ///< largest bias of a sound gyroscope

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);
};

/// Mean angular rate at rest. Refuses when the module moved: the spread of the rates or accelerations, the
/// difference between the two halves of the time, or the mean itself is too large.
class GyroCalibrator {
 public:
  /// Collects from its first sample on.
  explicit GyroCalibrator(const GyroCalibrationParams& params) : params_(params) {}

  /// A sample in order of time: rad/s and m/s^2.
  void add(double time_s, const Eigen::Vector3d& angular_velocity, const Eigen::Vector3d& acceleration);
  /// Whether samples of `duration_s` were added.
  bool complete() const;

  /// The bias, or the reason why there is none.
  struct Result {
    bool accepted = false;                             ///< the module rested
    Eigen::Vector3d bias = Eigen::Vector3d::Zero();    ///< rad/s
    Eigen::Vector3d stddev = Eigen::Vector3d::Zero();  ///< rad/s, of a single sample
    std::string message;  ///< what was found, or why it is refused and what to do
  };
  /// The result from all samples so far.
  Result result() const;

 private:
  GyroCalibrationParams params_;
  std::vector<double> times_s_;
  std::vector<Eigen::Vector3d> rates_, accelerations_;
};

/// Offset and scale per axis that put points on a sphere: |(p - offset) * scale| = radius.
struct SphereFit {
  bool accepted = false;                             ///< the points are those of a sphere
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< in the points' unit
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();   ///< factor per axis
  double residual_rms = 0.0;                         ///< of the magnitude, in the points' unit
  std::string message;                               ///< what was found, or why it is refused and what to do
};

/// Fits an axis-aligned ellipsoid, first algebraically (linear least squares), then on the magnitudes
/// (Gauss-Newton). Refuses when the points do not reach at least +-0.7 radius along every axis, or stay
/// farther than 5 % of the radius from the sphere. For an accelerometer turned slowly about each axis the
/// radius is 9.80665 m/s^2.
SphereFit fitSphere(const std::vector<Eigen::Vector3d>& points, double radius);

}  // namespace stereo_nav::imu
