#pragma once

#include <string>

namespace stereo_nav::ros_io {

/// Location from which the calibration of a camera is read, and to which it is saved, when the rig file names
/// none.
inline constexpr const char* kDefaultCalibrationUrl = "file://${ROS_HOME}/camera_info/${NAME}.yaml";

/// Returns the path that the URL of a calibration stands for: package://PACKAGE/PATH, file:///PATH or a plain
/// path. ${ROS_HOME} and ${NAME}, the camera's name, are replaced as camera_info_manager replaces them.
/// Throws ParameterError for any other scheme and for an unknown package.
std::string pathOfUrl(const std::string& url, const std::string& camera_name = "");

}  // namespace stereo_nav::ros_io
