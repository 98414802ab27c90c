#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::ros_io {

/// tf wants frame ids without the leading slash that old recordings have.
std::string withoutSlash(const std::string& frame_id);

/// Geometry of the pair from what the cameras say of themselves. Throws InputError when images and
/// camera_infos do not belong together: another frame id (image_geometry aborts the process on that), none,
/// another size, or a camera_info that is no stereo calibration.
vision::StereoCalibration checkedCalibration(const sensor_msgs::Image& left, const sensor_msgs::Image& right,
                                             const sensor_msgs::CameraInfo& left_info,
                                             const sensor_msgs::CameraInfo& right_info);

/// Whether the two describe the same camera; stamps do not matter.
bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b);

/// What to say while a transform is missing: its name, tf's own words, and the command that publishes it.
/// `sensor_is_camera` picks the example's rotation: optical axes or the body's.
std::string missingTransform(const std::string& base_frame, const std::string& sensor_frame,
                             bool sensor_is_camera, const std::string& tf_error);

}  // namespace stereo_nav::ros_io
