#pragma once

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// The images of one camera, rectified as the image_proc/rectify nodelet does it.
class RectifiedView {
 public:
  /// Throws InputError, whose message begins with `name`, if the camera_info is no calibration.
  RectifiedView(const std::string& name, const sensor_msgs::CameraInfo& info);

  /// Of the rectified image.
  double fx() const { return model_.fx(); }
  double fy() const { return model_.fy(); }
  double cx() const { return model_.cx(); }
  double cy() const { return model_.cy(); }
  const cv::Size& size() const { return size_; }
  /// What had to be assumed of the calibration, or changed in it; one line each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// CV_8UC1, bilinear. Throws InputError for an image that does not have the calibration's size.
  cv::Mat rectify(const cv::Mat& raw) const;

 private:
  std::string name_;
  image_geometry::PinholeCameraModel model_;
  cv::Size size_;
  std::vector<std::string> notes_;
};

}  // namespace stereo_nav::ros_io
