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

  /// The map's value at the nearest pixel; nothing outside the map and where the map has no disparity. The
  /// marker of "no disparity" (negative, zero or NaN; the thesis lifted it unchecked and got a block at -56
  /// m) is never lifted.
  std::optional<Lifted> lift(const cv::Mat& disparity, const cv::Point2f& pixel) const;

 private:
  DisparityLifterParams params_;
  StereoCalibration calibration_;
};

}  // namespace stereo_nav::vision
