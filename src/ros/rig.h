#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <string>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

/// Where a sensor sits in `base_link` (x forward, y left, z up). The angles turn about the fixed axes of
/// `base_link`, roll first, then pitch, then yaw, as in URDF.
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
};

/// Section `mounting` of a rig file.
struct Mounting {
  SensorMounting camera;  ///< the left camera as a body that looks along its x axis
  SensorMounting imu;     ///< the axes that the IMU's messages are in

  void describe(ParameterVisitor& visitor);
  /// The left optical frame (x right, y down, z forward) in `base_link`.
  Eigen::Isometry3d T_base_optical() const;
};

/// Sections of a rig file (config/rigs/thesis.yaml).
namespace rig_sections {
constexpr const char* kCameras = "cameras";      ///< stereo_capture's parameters
constexpr const char* kImu = "imu";              ///< imu_bridge's
constexpr const char* kMounting = "mounting";    ///< Mounting
constexpr const char* kDisparity = "disparity";  ///< DisparityParams
}  // namespace rig_sections

/// One section of a rig file; an empty node where the file has none. Throws ParameterError when the file
/// cannot be read, is no map, or holds a section that nobody knows.
YAML::Node loadRigSection(const std::string& path, const std::string& section);

/// What messages call a section of a rig file.
std::string rigSectionName(const std::string& path, const std::string& section);

/// Reads and checks the section `mounting`. Throws ParameterError.
Mounting loadMounting(const std::string& path);

/// Where the calibration of a camera that none is named for is looked for, and saved.
inline constexpr const char* kDefaultCalibrationUrl = "file://${ROS_HOME}/camera_info/${NAME}.yaml";

/// Path of a URL as calibrations are named by: package://PACKAGE/PATH, file:///PATH or a plain path, with
/// ${ROS_HOME} and ${NAME}, the camera's, as camera_info_manager replaces them. Throws ParameterError for
/// another scheme and an unknown package.
std::string pathOfUrl(const std::string& url, const std::string& camera_name = "");

}  // namespace stereo_nav::ros_io
