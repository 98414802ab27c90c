#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::calibration {

/// One camera of a calibrated pair, with the matrices of its camera_info (sensor_msgs/CameraInfo). Pixels
/// count from the centre of the upper left one.
struct CameraModel {
  cv::Size size;  ///< px
  cv::Matx33d K;  ///< raw pixels of rays in the raw optical frame
  cv::Mat D;  ///< 1xN CV_64FC1, N of 4, 5, 8, ...: OpenCV's order k1 k2 p1 p2 k3 ...; equidistant: k1 to k4
  cv::Matx33d R;             ///< raw optical -> rectified optical frame
  cv::Matx34d P;             ///< rectified pixels of points in the rectified left optical frame
  bool equidistant = false;  ///< D is of OpenCV's fisheye model

  /// The rays of raw pixels, where they cross z = 1 of the raw optical frame.
  std::vector<cv::Point2d> rays(const std::vector<cv::Point2d>& raw_px) const;

  /// The positions of raw pixels in the rectified image.
  std::vector<Eigen::Vector2d> rectify(const std::vector<cv::Point2f>& raw_px) const;

  /// Angle between the rays of the middles of two opposite edges of the raw image, rad.
  double horizontalView_rad() const;
  /// The same of the upper and lower edge, rad.
  double verticalView_rad() const;
};

/// A calibrated pair.
struct StereoRig {
  CameraModel left;                     ///< the camera whose optical frame is that of the pair
  CameraModel right;                    ///< the other camera
  vision::StereoCalibration rectified;  ///< what both P say
};

/// Angle of view of the rectified image, rad.
double rectifiedView_rad(double focal_length_px, double centre_px, int size_px);

}  // namespace stereo_nav::calibration
