#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::estimation {

/// What one message of a sensor says. Fields 0 to 2 are along x, y and z, 3 to 5 about them.
struct Measurement {
  enum class Kind {
    kPose,         ///< of base_link in the filter's world; rotations as roll, pitch, yaw
    kMotion,       ///< pose of base_link in the odometry's own frame, of which only motions count
    kTwist,        ///< of base_link, its axes; m/s, rad/s
    kRate,         ///< of a gyroscope, fields 3 to 5, axes of base_link; rad/s
    kAcceleration  ///< of an accelerometer, fields 0 to 2, axes of base_link; m/s^2, with gravity
  };
  int channel = 0;  ///< of the filter: a kind of measurement of one sensor
  double time_s = 0.0;
  Kind kind = Kind::kTwist;
  std::vector<int> fields;                                  ///< that are used
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();   ///< kPose, kMotion
  Vector6d value = Vector6d::Zero();                        ///< the other kinds
  Matrix6d covariance = Matrix6d::Zero();                   ///< of pose (axes of its frame) or value
  std::optional<Matrix6d> twist_covariance;                 ///< kMotion: of the twist in the same message
  Eigen::Vector3d p_base_sensor = Eigen::Vector3d::Zero();  ///< kAcceleration: where it sits, m
};

/// A reason why a field is left out or its variance replaced.
struct FieldFinding {
  std::string key;   ///< what is to be said once
  std::string text;  ///< what was seen and what is done instead
};

/// Standard deviations that stand in for variances that cannot be right.
struct DefaultSigmas {
  double position_m = 0.1;
  double attitude_rad = 0.05;
  double velocity_m_s = 0.1;
  double turn_rate_rad_s = 0.1;
  double gyro_rad_s = 0.01;
  double acceleration_m_s2 = 0.3;
};

/// Leaves out the fields whose values are not finite, absurd (beyond 1e6) or said to be unknown (a variance
/// of 1e5 or more, or -1 and less), and replaces variances that are zero or no numbers by the default.
/// Covariances between fields are dropped where they do not fit the variances. Returns what it found.
std::vector<FieldFinding> checkFields(const DefaultSigmas& sigmas, Measurement& measurement);

}  // namespace stereo_nav::estimation
