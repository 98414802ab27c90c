#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <Eigen/Core>
#include <string>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::test {

struct FixtureBag {
  int frames = 20;
  double period_s = 0.1;
  double right_lag_s = 0.0;  ///< the right image is taken this much later, and stamped so
  double toe_in_rad =
      0.0;  ///< the raw right camera looks this far to the left; R of its camera_info undoes it
  bool with_imu = true;
  bool with_ground_truth = true;
  bool with_transforms = true;
  bool compressed_bayer = false;  ///< mosaics as PNG on image_raw/compressed instead of grey images
  int info_every = 1;             ///< images, of which the first has a camera_info
  std::string rig;                ///< namespace of the rig ("/b"); the bag then holds images of a rig /a, too
};

/// Writes roomDrive() through the textured room as a bag of a stereo rig (topics.h), each image with its own
/// true stamp, `imu/data` at 100 Hz, `ground_truth/odom` and `tf_static`. Same arguments, same messages.
void writeFixtureBag(const std::string& path, const FixtureBag& fixture);

/// Turns the axes of a raw camera that looks to the left by the angle into those of its rectified image.
Eigen::Matrix3d rectifiedFromRaw(double toe_in_rad);

/// camera_info of one camera of an ideal, rectified pair.
sensor_msgs::CameraInfo cameraInfo(const vision::StereoCalibration& calibration, bool right);

}  // namespace stereo_nav::test
