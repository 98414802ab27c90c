#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

namespace stereo_nav::ros_io {

/// Reads a calibration as camera_calibration saves it. Throws InputError that names the file: it does not
/// exist, cannot be read, or names a camera model whose images are not rectified as those of a pinhole
/// camera, which ROS's own reader does not look at.
sensor_msgs::CameraInfo readCalibrationFile(const std::string& path);

}  // namespace stereo_nav::ros_io
