#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// The properties that both image sensors share.
struct SensorParams {
  double exposure_ms = 12.0;
  double rolling_shutter_ms = 0.0;
  double read_noise = 1.2;
  double shot_noise = 0.12;
  double vignetting = 0.15;

  void describe(ParameterVisitor& visitor);
};

/// The properties in which two cameras of one type differ.
struct CameraResponse {
  double gain = 1.0;
  double offset = 0.0;

  void describe(ParameterVisitor& visitor);
};

/// Turns light into the camera's 8 bit image: vignetting, gain, black level, noise, rounding, saturation.
class ImageSensor {
 public:
  ImageSensor(int width, int height, const SensorParams& sensor, const CameraResponse& response);

  /// `light` CV_32FC1 in grey levels; returns CV_8UC1. Noise is a function of (`noise_key`, pixel) alone.
  cv::Mat expose(const cv::Mat& light, std::uint64_t noise_key) const;

 private:
  SensorParams sensor_;
  CameraResponse response_;
  cv::Mat vignetting_;  ///< factor of every pixel, CV_32FC1
};

}  // namespace stereo_nav::sim
