#pragma once

#include <Eigen/Core>

#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::vision {

struct EpipolarErrorParams {
  double prior_sigma_px = 2.0;
  double memory = 20000.0;

  void describe(ParameterVisitor& visitor);
};

/// The displacement of the right image against a perfect rectification. A camera that has pitched moves all
/// rows, one that has rolled tilts them, and one of another focal length spreads them. These three are
/// learned from the rows of the matches, by robust recursive least squares with a fading memory. The
/// displacement of the columns that goes with them is corrected, too: half a pixel of row error at the edge
/// of the image comes with as much error of the disparity at its lower edge. Webcams in a home-made mount are
/// off by a pixel or two some time after their calibration, the public recordings by a few tenths. Errors
/// that leave the rows unchanged, such as a yawed camera or a wrong baseline, cannot be learned.
class EpipolarError {
 public:
  EpipolarError(const EpipolarErrorParams& params, const StereoCalibration& calibration);

  /// The displacement at a right pixel, px, to be subtracted from it.
  Eigen::Vector2d at(const Eigen::Vector2d& right_px) const;

  /// Uncertainty of the rows of at() in the middle of the image, 3 sigma, px.
  double slack_px() const;

  /// Adds a match whose right row is `error_px` too low in the image, before the correction by at().
  void add(const Eigen::Vector2d& right_px, double error_px);
  /// Updates at() by the matches that were added.
  void learn();
  void reset();

 private:
  Eigen::Vector3d basis(const Eigen::Vector2d& right_px) const;

  EpipolarErrorParams params_;
  StereoCalibration calibration_;
  Eigen::Vector3d coefficients_px_;  ///< of the row error over (1, x/z, y/z): pitch, roll, focal length
  Eigen::Matrix3d prior_;
  Eigen::Matrix3d information_;  ///< in matches
  Eigen::Vector3d moments_;
};

}  // namespace stereo_nav::vision
