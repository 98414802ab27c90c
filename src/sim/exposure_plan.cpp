#include "sim/exposure_plan.h"

namespace stereo_nav::sim {
namespace {

/// What the corners count, where the middle counts 1.
constexpr double kCornerWeight = 0.3;

}  // namespace

double signalPerLight(const SensorParams& sensor, double exposure_ms) {
  return sensor.full_scale_ms > 0.0 ? exposure_ms / sensor.full_scale_ms : 1.0;
}

std::vector<ExposureSetting> planExposures(const SensorParams& sensor, std::size_t images,
                                           const ExposureMeter& meter) {
  if (!sensor.auto_exposure.on) return {images, ExposureSetting{sensor.exposure_ms, 1.0}};
  AutoExposure loop(sensor.auto_exposure, sensor.exposure_ms, sensor.processing.gamma);
  for (int before = 0; before < kImagesBefore && images > 0; ++before) loop.see(meter(0, loop.setting()));
  std::vector<ExposureSetting> plan;
  for (std::size_t image = 0; image < images; ++image) {
    plan.push_back(loop.setting());
    loop.see(meter(image, plan.back()));
  }
  return plan;
}

double meteredGrey(const cv::Mat& signal, double gain, const ImageProcessing& processing) {
  double sum = 0.0, weights = 0.0;
  for (int y = 0; y < signal.rows; ++y) {
    const double dy = (y + 0.5) / signal.rows - 0.5;
    for (int x = 0; x < signal.cols; ++x) {
      const double dx = (x + 0.5) / signal.cols - 0.5;
      const double weight = 1.0 - (1.0 - kCornerWeight) * 2.0 * (dx * dx + dy * dy);
      sum += weight * processing.tone(static_cast<float>(gain) * signal.at<float>(y, x));
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace stereo_nav::sim
