#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace stereo_nav::vision {

/// One camera's calibration: the fields of a sensor_msgs/CameraInfo under their names. Pixels count from the
/// centre of the upper left one.
struct CameraFields {
  cv::Size size;                 ///< width and height of the image that was calibrated, px
  std::string distortion_model;  ///< plumb_bob, rational_polynomial or equidistant
  std::vector<double> D;         ///< coefficients, in OpenCV's order
  cv::Matx33d K;                 ///< raw pixels of rays in the raw optical frame
  cv::Matx33d R;                 ///< raw optical -> rectified optical frame
  cv::Matx34d P;                 ///< rectified pixels of points in the rectified left optical frame
  cv::Size binning;  ///< pixels of the calibrated image that make one of the delivered one; 0 is 1
  cv::Rect roi;      ///< part of the calibrated image that is delivered; all 0: all of it
};

/// "640x480"
inline std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace stereo_nav::vision
