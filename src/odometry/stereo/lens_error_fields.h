#pragma once

#include <Eigen/Core>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::odometry {

/// Errors that the calibration of a lens leaves over: small changes of the coefficients of the lens model
/// (Brown 1966), less what a shift and a change of the focal length explain, which are errors of their own.
/// The fields are radial (k1, with whose field that of k2 all but agrees) and tangential (p1, p2). Together
/// they have an RMS of 1 px over the image, the radial one half of the variance.
class LensErrorFields {
 public:
  static constexpr int kFields = 3;
  using Shifts = Eigen::Matrix<double, 2, kFields>;

  explicit LensErrorFields(const vision::StereoCalibration& calibration);

  /// By how much each field shifts what is seen at `ray`: (x/z, y/z) in this camera. In px, rows x, y.
  Shifts at(const Eigen::Vector2d& ray) const;

 private:
  Shifts scale_ = Shifts::Zero();   ///< that is taken away, px per ray
  Shifts offset_ = Shifts::Zero();  ///< likewise, px
  Eigen::Array<double, 1, kFields> unit_ = Eigen::Array<double, 1, kFields>::Ones();
};

}  // namespace stereo_nav::odometry
