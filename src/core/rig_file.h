#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

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
  /// For a camera, which looks along the x axis of its body: takes coordinates of its optical frame (x right,
  /// y down, z forward) into `base_link`.
  Eigen::Isometry3d T_base_optical() const;
  /// Sets the angles in degrees: roll and yaw from -180 to 180, pitch from -90 to 90. Where the sensor's x
  /// axis is vertical, roll and yaw turn about the same axis; the whole rotation is then stored as yaw and
  /// roll is 0.
  void setRotation(const Eigen::Matrix3d& R_base_sensor);
};

/// Section `mounting` of a rig file. What stands in a list (servos, range finders) has its place there.
struct Mounting {
  SensorMounting camera;  ///< the left camera as a body that looks along its x axis
  SensorMounting imu;     ///< the axes of the IMU's messages
  SensorMounting
      laser;  ///< the axes of the scans: x along the scanner's own zero; roll 180 where it hangs upside down

  void describe(ParameterVisitor& visitor);
};

/// Sections of a rig file (config/rigs/thesis.yaml).
namespace rig_sections {
constexpr const char* kCameras = "cameras";               ///< stereo_capture's parameters
constexpr const char* kImu = "imu";                       ///< imu_bridge's parameters
constexpr const char* kLaser = "laser";                   ///< laser_bridge's parameters
constexpr const char* kRangeFinders = "range_finders";    ///< range_bridge's parameters
constexpr const char* kMounting = "mounting";             ///< Mounting
constexpr const char* kDisparity = "disparity";           ///< parameters of stereo_image_proc/disparity
constexpr const char* kDrive = "drive";                   ///< the wheels: kinematics::readDrive()
constexpr const char* kWheelOdometry = "wheel_odometry";  ///< wheel_odometry's parameters
constexpr const char* kUncertainty = "uncertainty";       ///< what the cameras' calibration is uncertain by
constexpr const char* kBase = "base";                     ///< base_bridge's parameters
}  // namespace rig_sections

/// A rig file holds everything that is specific to one robot. This is the only reader and writer of such
/// files. All functions throw ParameterError, with a message that begins with the file's name.
class RigFile {
 public:
  /// Reads a file. Throws if it cannot be read, holds no sections, or holds an unknown section.
  static RigFile load(const std::string& path);
  /// Reads `text`, which messages call `source`.
  static RigFile parse(const std::string& text, const std::string& source);

  /// Returns a section; an empty node where the file has no such section.
  YAML::Node section(const std::string& name) const;
  /// The name that messages give a section of this file.
  std::string sectionName(const std::string& name) const;

  /// Returns the checked section `mounting`. Values that it does not give are zero.
  Mounting mounting() const;

  /// Throws unless `mounting/SENSOR` of the file holds the three angles as numbers.
  void requireRotation(const std::string& sensor) const;
  /// Replaces the angles of `mounting/SENSOR` by those of `R_base_sensor`, rounded to 0.01 deg. Every other
  /// byte of the text stays as it is, including comments and line ends.
  void setRotation(const std::string& sensor, const Eigen::Matrix3d& R_base_sensor);

  /// Sets the number at `path`, e.g. {"drive", "wheel_1", "radius_m"}. Where its map has no such line, one is
  /// inserted before the first; a section that the file does not have is appended. Every other byte of the
  /// text stays as it is.
  void setNumber(const std::vector<std::string>& path, const std::string& value);

  const std::string& text() const { return text_; }

 private:
  RigFile(std::string text, std::string source);
  YAML::Node numberNode(const std::string& sensor, const std::string& name) const;
  void replaceNumber(const YAML::Node& node, const std::string& full_name, const std::string& value);
  void insert(const YAML::Node& map, const std::string& name, const std::string& value);
  void edit(std::size_t position, std::size_t length, const std::string& text);

  std::string text_;
  std::string source_;
  YAML::Node root_;
};

}  // namespace stereo_nav
