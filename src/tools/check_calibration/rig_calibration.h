#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "stereo_nav/calibration/stereo_rig.h"

namespace stereo_nav::tools {

struct CameraInfos {
  sensor_msgs::CameraInfo left;
  sensor_msgs::CameraInfo right;
};

/// left.yaml and right.yaml of a folder, as camera_calibration saves them. Throws InputError.
CameraInfos readCalibrationFolder(const std::string& folder);

/// Throws InputError for infos that judgeInfos() refuses.
calibration::StereoRig toStereoRig(const CameraInfos& infos);

}  // namespace stereo_nav::tools
