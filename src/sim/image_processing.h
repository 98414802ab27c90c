#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// What a webcam's processor makes of the sensor's signal before it sends an image.
struct ProcessingParams {
  double gamma = 1.0;       ///< 1 is linear
  double sharpening = 0.0;  ///< 0 is none
  double sharpening_px = 1.0;
  double jpeg_kb = 0.0;  ///< of 640x480; 0: not compressed

  void describe(ParameterVisitor& visitor);
  bool linear() const { return gamma == 1.0 && sharpening == 0.0 && jpeg_kb == 0.0; }
};

/// An image as MJPEG sends it.
struct CompressedImage {
  std::vector<uchar> bytes;
  int quality = 0;  ///< of libjpeg, 1 to 100
};

/// Tone curve, sharpening, rounding, JPEG. Each is a pure function of its image.
class ImageProcessing {
 public:
  explicit ImageProcessing(const ProcessingParams& params);

  /// The CV_8UC1 image that the receiver decodes from a CV_32FC1 signal of grey levels.
  cv::Mat develop(const cv::Mat& signal) const;

  /// Grey levels (0 to 255) of a linear signal; 0 and 255 stay, what is beyond is clipped.
  float tone(float signal) const;

  /// Adds `sharpening` times the difference from the blurred image, in place: a step of height h overshoots
  /// by sharpening * h * P(normal > 0.5 / sharpening_px) in the pixels beside it.
  void sharpen(cv::Mat& image) const;

  /// Compressed to about jpeg_kb for each 640x480 pixels, by the quality: a search in a fixed number of
  /// steps. An image with little in it stays smaller even at the best quality a webcam uses.
  CompressedImage compress(const cv::Mat& image) const;

 private:
  ProcessingParams params_;
  std::vector<float> curve_;  ///< of equally spaced signals from 0 to 255
};

}  // namespace stereo_nav::sim
