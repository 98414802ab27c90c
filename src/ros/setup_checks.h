#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "ros/judged_infos.h"

namespace stereo_nav::ros_io {

/// Removes the leading slash that frame ids in old recordings have; tf requires ids without it.
std::string withoutSlash(const std::string& frame_id);

/// The cameras' camera_infos, judged (judgeInfos()). Throws InputError also when rectified images and
/// camera_infos do not belong together: their frame ids differ (image_geometry would abort the process), the
/// frame id is empty, or their sizes differ.
JudgedInfos checkedInfos(const sensor_msgs::Image& left, const sensor_msgs::Image& right,
                         const sensor_msgs::CameraInfo& left_info, const sensor_msgs::CameraInfo& right_info);

/// Whether the two describe the same camera; stamps do not matter.
bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b);

/// Message for images of which left is right.
std::string swappedCameras();

/// Message for right images whose stamps are constantly off by `error_s`, stamp minus true time.
std::string wrongRightStamps(double error_s);

/// Message for a missing transform: its name, tf's own error, and a command that publishes it.
/// `sensor_is_camera` selects the rotation in the example: that of optical axes or that of the body's axes.
std::string missingTransform(const std::string& base_frame, const std::string& sensor_frame,
                             bool sensor_is_camera, const std::string& tf_error);

}  // namespace stereo_nav::ros_io
