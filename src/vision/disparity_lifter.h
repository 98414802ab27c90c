#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::vision {

struct DisparityLifterParams {
  double min_disparity_px = 0.5;

  void describe(ParameterVisitor& visitor);
};

/// Turns pixels into points with the dense disparity map (thesis, step 2).
class DisparityLifter {
 public:
  DisparityLifter(const DisparityLifterParams& params, const StereoCalibration& calibration);

  struct Lifted {
    Eigen::Vector3d p_camera;  ///< left optical frame, m
    double disparity_px;
  };

  /// The map is read at the nearest pixel. Nothing is returned outside the map and where the map has no
  /// disparity, which it marks by a negative value, zero or NaN. (The thesis lifted these marks unchecked and
  /// got points at -56 m.)
  std::optional<Lifted> lift(const cv::Mat& disparity, const cv::Point2f& pixel) const;

 private:
  DisparityLifterParams params_;
  StereoCalibration calibration_;
};

}  // namespace stereo_nav::vision
