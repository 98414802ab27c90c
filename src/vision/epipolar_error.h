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

/// The error of the places in the right image against those of a perfect rectification: a camera that nods
/// moves all rows, one that rolls tilts them, one of another focal length spreads them. The three are learned
/// from the rows of the matches themselves, by robust recursive least squares with a fading memory, and the
/// columns that go with them are corrected too: half a pixel of row error at the edge of the image comes with
/// as much error of disparity at its foot. The rows of webcams in a home-made mount are a pixel or two off
/// some time after their calibration, those of the public recordings a few tenths. Errors that do not change
/// the rows (a camera that turns sideways, a wrong baseline) cannot be observed.
class EpipolarError {
 public:
  EpipolarError(const EpipolarErrorParams& params, const StereoCalibration& calibration);

  /// px, to be subtracted from a right pixel.
  Eigen::Vector2d at(const Eigen::Vector2d& right_px) const;

  /// px, how far off at() may still be, 3 sigma of the rows in the middle of the image.
  double slack_px() const;

  /// How the row at this pixel goes along with a nod, a roll and another focal length of the right camera.
  Eigen::Vector3d basis(const Eigen::Vector2d& right_px) const;

  /// One match whose right row is `error_px` too low, what at() says included.
  void add(const Eigen::Vector2d& right_px, double error_px);
  /// Draws the conclusion from the matches added.
  void learn();

 private:
  EpipolarErrorParams params_;
  StereoCalibration calibration_;
  Eigen::Vector3d coefficients_px_;  ///< row error for (1, x/z, y/z): nod, roll, focal length
  Eigen::Matrix3d prior_;
  Eigen::Matrix3d information_;  ///< in matches
  Eigen::Vector3d moments_;
};

}  // namespace stereo_nav::vision
