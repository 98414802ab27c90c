#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>
#include <vector>

#include "stereo_nav/vision/stereo_calibration.h"
#include "vision/camera_fields.h"

namespace stereo_nav::ros_io {

/// Both camera_infos as vision::judgePair() leaves them: what evaluate, the nodes and the image nodelets use.
struct JudgedInfos {
  sensor_msgs::CameraInfo left;
  sensor_msgs::CameraInfo right;
  vision::StereoCalibration calibration;
  std::vector<std::string> notes;  ///< what was assumed or changed, one line each
};

/// The fields of a camera_info that make the calibration.
vision::CameraFields toFields(const sensor_msgs::CameraInfo& info);

/// The camera_info of judged fields, all of which are of the image as it is delivered.
sensor_msgs::CameraInfo toInfo(const vision::CameraFields& fields, const std_msgs::Header& header);

/// Judges the camera_infos of a pair before they are used. Throws InputError as vision::judgePair() does, and
/// where the frame ids differ, on which image_geometry would abort the process.
JudgedInfos judgeInfos(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right);

/// Whether a camera_info says anything: drivers publish zeros until they have read their calibration.
bool isCalibrated(const sensor_msgs::CameraInfo& info);

}  // namespace stereo_nav::ros_io
