#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::test {

struct FixtureBag {
  int frames = 20;
  double period_s = 0.1;
  double right_lag_s = 0.0;  ///< the right image is taken this much later, and stamped so
  bool with_imu = true;
  bool with_ground_truth = true;
  bool with_transforms = true;
};

/// Writes roomDrive() through the textured room as a bag of a stereo rig (topics.h), each image with its own
/// true stamp, `imu/data` at 100 Hz, `ground_truth/odom` and `tf_static`. Same arguments, same messages.
void writeFixtureBag(const std::string& path, const FixtureBag& fixture);

/// camera_info of one camera of an ideal, rectified pair.
sensor_msgs::CameraInfo cameraInfo(const vision::StereoCalibration& calibration, bool right);

}  // namespace stereo_nav::test
