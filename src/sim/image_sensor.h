#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "sim/image_processing.h"
#include "sim/sensor_params.h"

namespace stereo_nav::sim {

/// Turns light into the camera's 8 bit image: vignetting, speck, gain, black level, noise, amplifier, and
/// then rounding and saturation, or all that a webcam's processor does.
class ImageSensor {
 public:
  ImageSensor(int width, int height, const SensorParams& sensor, const CameraResponse& response);

  /// `light` CV_32FC1 in grey levels; returns CV_8UC1. Noise is a function of (`noise_key`, pixel) alone.
  /// The `amplifier` multiplies signal and noise.
  cv::Mat expose(const cv::Mat& light, std::uint64_t noise_key, double amplifier = 1.0) const;

  const ImageProcessing& processing() const { return processing_; }

 private:
  void addSpeck(const SpeckParams& speck);

  SensorParams sensor_;
  CameraResponse response_;
  ImageProcessing processing_;
  cv::Mat transmission_;  ///< of the lens for every pixel, CV_32FC1
};

}  // namespace stereo_nav::sim
