#pragma once

#include <image_geometry/stereo_camera_model.h>
#include <sensor_msgs/CameraInfo.h>
#include <stereo_image_proc/processor.h>

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::ros_io {

/// config/disparity.yaml: names, ranges and defaults are those of the stereo_image_proc/disparity nodelet's
/// dynamic_reconfigure, since the nodelet loads the same file.
struct DisparityParams {
  int stereo_algorithm = 0;
  int prefilter_size = 9;
  int prefilter_cap = 31;
  int correlation_window_size = 15;
  int min_disparity = 0;
  int disparity_range = 64;
  double uniqueness_ratio = 15.0;
  int texture_threshold = 10;
  int speckle_size = 100;
  int speckle_range = 4;
  bool fullDP = false;
  double P1 = 200.0;
  double P2 = 400.0;
  int disp12MaxDiff = 0;

  void describe(ParameterVisitor& visitor);
};

/// Rectification and disparity by the same library code that the image_proc/rectify and
/// stereo_image_proc/disparity nodelets run, without a graph. Not thread-safe (the block matcher keeps
/// scratch buffers).
class StereoProcessing {
 public:
  /// Throws InputError if the camera_infos are no stereo calibration (judgeInfos()).
  StereoProcessing(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right,
                   const DisparityParams& disparity);

  const vision::StereoCalibration& calibration() const { return calibration_; }
  /// What had to be assumed of the calibration, or changed in it; one line each.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Rectifies to CV_8UC1, with bilinear interpolation, which is the nodelet's default. Throws InputError for
  /// images that do not have the calibration's size.
  cv::Mat rectifyLeft(const cv::Mat& raw) const;
  cv::Mat rectifyRight(const cv::Mat& raw) const;

  /// Disparity in px, CV_32FC1, -1 where there is none.
  cv::Mat disparity(const cv::Mat& left_rect, const cv::Mat& right_rect) const;

 private:
  cv::Mat rectify(const image_geometry::PinholeCameraModel& camera, const cv::Mat& raw,
                  const char* side) const;

  vision::StereoCalibration calibration_;
  std::vector<std::string> notes_;
  image_geometry::StereoCameraModel model_;
  stereo_image_proc::StereoProcessor processor_;
};

}  // namespace stereo_nav::ros_io
