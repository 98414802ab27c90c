#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <string>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav {

/// Where a sensor sits in `base_link` (x forward, y left, z up). The angles turn about the fixed axes of
/// `base_link`, roll first, then pitch, then yaw, as in URDF: R = Rz(yaw) Ry(pitch) Rx(roll).
struct SensorMounting {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;

  void describe(ParameterVisitor& visitor);

  /// Takes coordinates of the sensor's body (x forward, y left, z up) into `base_link`.
  Eigen::Isometry3d T_base_sensor() const;
  /// Of a camera, which looks along the x axis of its body: takes coordinates of its optical frame (x right,
  /// y down, z forward) into `base_link`.
  Eigen::Isometry3d T_base_optical() const;
  /// Sets the angles: roll and yaw from -180 to 180, pitch from -90 to 90. Where the sensor's x axis is
  /// vertical, roll and yaw turn about one axis; all of that turn is called yaw then.
  void setRotation(const Eigen::Matrix3d& R_base_sensor);
};

/// Section `mounting` of a rig file.
struct Mounting {
  SensorMounting camera;  ///< the left camera as a body that looks along its x axis
  SensorMounting imu;     ///< the axes that the IMU's messages are in

  void describe(ParameterVisitor& visitor);
};

/// Sections of a rig file (config/rigs/thesis.yaml).
namespace rig_sections {
constexpr const char* kCameras = "cameras";      ///< stereo_capture's parameters
constexpr const char* kImu = "imu";              ///< imu_bridge's
constexpr const char* kMounting = "mounting";    ///< Mounting
constexpr const char* kDisparity = "disparity";  ///< those of stereo_image_proc/disparity
}  // namespace rig_sections

/// A rig file: everything that is true of one robot and of no other. This is the only reader and writer of
/// such files. All functions throw ParameterError, with a message that begins with the file's name.
class RigFile {
 public:
  /// Refuses a file that cannot be read, holds no sections, or holds one that nobody knows.
  static RigFile load(const std::string& path);
  /// `source` is what messages call the text.
  static RigFile parse(const std::string& text, const std::string& source);

  /// An empty node where the file has no such section.
  YAML::Node section(const std::string& name) const;
  /// What messages call a section of this file.
  std::string sectionName(const std::string& name) const;

  /// The section `mounting`, checked; what it leaves out is zero.
  Mounting mounting() const;

  /// Requires that `mounting/SENSOR` of the file holds the three angles as numbers.
  void requireRotation(const std::string& sensor) const;
  /// Writes the angles of `R_base_sensor`, to 0.01 deg, in the place of those of `mounting/SENSOR`.
  /// Everything else in the text, comments and line ends included, stays as it is to the byte.
  void setRotation(const std::string& sensor, const Eigen::Matrix3d& R_base_sensor);

  const std::string& text() const { return text_; }

 private:
  RigFile(std::string text, std::string source);
  YAML::Node numberNode(const std::string& sensor, const std::string& name) const;
  void setNumber(const std::string& sensor, const std::string& name, const std::string& value);

  std::string text_;
  std::string source_;
  YAML::Node root_;
};

}  // namespace stereo_nav
