#pragma once

#include <deque>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// How a camera chooses exposure time and gain by itself.
struct AutoExposureParams {
  bool on = false;
  double max_gain = 16.0;
  double min_exposure_ms = 0.1;
  double target = 110.0;  ///< mean grey level of the image, after the tone curve
  double speed = 0.35;    ///< share of the error (in stops) that one image corrects
  int delay_images = 2;   ///< a setting shows in the image after so many
  double tolerance_stops = 0.3;

  void describe(ParameterVisitor& visitor);
};

/// What an image is taken with.
struct ExposureSetting {
  double exposure_ms = 0.0;
  double gain = 1.0;  ///< of the amplifier: on signal and noise alike
};

/// The control loop of a webcam: from the mean grey level of each image to the setting of a later one.
/// It corrects a share of the error in each image, but a setting shows only some images later, so that it
/// overshoots and comes back: it hunts. Small errors are left alone. Exposure is as long as it may be before
/// the amplifier is used. State goes from image to image; the result depends on the grey levels alone.
class AutoExposure {
 public:
  AutoExposure(const AutoExposureParams& params, double longest_exposure_ms, double gamma);

  /// With what the next image is taken.
  ExposureSetting setting() const;

  /// An image was taken with setting(); `mean_grey` is its mean after the tone curve, 0 to 255.
  void see(double mean_grey);

 private:
  AutoExposureParams params_;
  double longest_exposure_ms_;
  double gamma_;
  double stops_ = 0.0;          ///< log2 of exposure (ms) times gain that the loop asks for
  std::deque<double> pending_;  ///< asked for, not yet in an image; the first is that of the next image
  bool correcting_ = false;
};

}  // namespace stereo_nav::sim
