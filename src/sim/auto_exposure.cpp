#include "sim/auto_exposure.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::sim {
namespace {

/// Registers of exposure and gain are whole numbers: settings differ by at least this much.
constexpr double kStep_stops = 1.0 / 16.0;
/// A white or black image does not say how far off it is; nothing is corrected by more than this at once.
constexpr double kLargestError_stops = 3.0;
/// Once it corrects it goes on until the error is this share of what made it begin.
constexpr double kGoodEnough = 0.4;

}  // namespace

AutoExposure::AutoExposure(const AutoExposureParams& params, double longest_exposure_ms, double gamma)
    : params_(params),
      longest_exposure_ms_(std::max(longest_exposure_ms, params.min_exposure_ms)),
      gamma_(gamma),
      stops_(std::log2(longest_exposure_ms_)),
      pending_(static_cast<std::size_t>(params.delay_images) + 1, stops_) {}

ExposureSetting AutoExposure::setting() const {
  const double total_ms = std::exp2(kStep_stops * std::round(pending_.front() / kStep_stops));
  ExposureSetting setting;
  setting.exposure_ms = std::clamp(total_ms, params_.min_exposure_ms, longest_exposure_ms_);
  setting.gain = std::clamp(total_ms / setting.exposure_ms, 1.0, params_.max_gain);
  return setting;
}

void AutoExposure::see(double mean_grey) {
  // The tone curve is about grey ~ light^(1 / gamma).
  const double error_stops = std::clamp(gamma_ * std::log2(params_.target / std::max(mean_grey, 0.5)),
                                        -kLargestError_stops, kLargestError_stops);
  const double begin = params_.tolerance_stops;
  correcting_ = std::fabs(error_stops) > (correcting_ ? kGoodEnough * begin : begin);
  if (correcting_) stops_ += params_.speed * error_stops;
  stops_ = std::clamp(stops_, std::log2(params_.min_exposure_ms),
                      std::log2(longest_exposure_ms_ * params_.max_gain));
  pending_.push_back(stops_);
  pending_.pop_front();
}

void AutoExposureParams::describe(ParameterVisitor& visitor) {
  visitor.flag("on", on, "the camera chooses exposure time (at most exposure_ms) and gain by itself");
  visitor.real("max_gain", max_gain, {1.0, 1000.0}, "", "largest gain of the amplifier");
  visitor.real("min_exposure_ms", min_exposure_ms, {0.001, 100.0}, "ms", "shortest exposure");
  visitor.real("target", target, {1.0, 254.0}, "grey levels", "mean grey level that it aims at");
  visitor.real(
      "speed", speed, {0.01, 1.0}, "",
      "share of the error that one image corrects; with a delay of 2 it hunts above 0.15, for ever above 0.6");
  visitor.integer("delay_images", delay_images, {0, 10}, "", "images that go by until a setting shows");
  visitor.real("tolerance_stops", tolerance_stops, {0.0, 3.0}, "stops", "errors up to this are left alone");
}

}  // namespace stereo_nav::sim
