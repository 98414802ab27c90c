#include "sim/image_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

/// Standard normal draws, precomputed: a pixel's random bits select one. Each has its mirror image in the
/// table, so that the mean is 0 exactly.
constexpr std::size_t kTableSize = 4096;

const std::array<float, kTableSize>& normalTable() {
  static const std::array<float, kTableSize> table = [] {
    std::array<float, kTableSize> draws{};
    for (std::size_t i = 0; i < kTableSize; i += 2) {
      draws[i] = static_cast<float>(normalDraw(0x6E6F697365ull, i));
      draws[i + 1] = -draws[i];
    }
    return draws;
  }();
  return table;
}

}  // namespace

ImageSensor::ImageSensor(int width, int height, const SensorParams& sensor, const CameraResponse& response)
    : sensor_(sensor),
      response_(response),
      processing_(sensor.processing),
      transmission_(height, width, CV_32FC1) {
  const double cx = 0.5 * (width - 1), cy = 0.5 * (height - 1), corner2 = cx * cx + cy * cy;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double r2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / corner2;
      transmission_.at<float>(y, x) = static_cast<float>(1.0 - sensor.vignetting * r2);
    }
  }
  if (response.speck.opacity > 0.0) addSpeck(response.speck);
}

/// A speck is far out of focus: its shadow fades from the middle to the rim.
void ImageSensor::addSpeck(const SpeckParams& speck) {
  const double cx = speck.x * transmission_.cols - 0.5, cy = speck.y * transmission_.rows - 0.5;
  const double radius_px = speck.radius * transmission_.cols;
  for (int y = 0; y < transmission_.rows; ++y) {
    for (int x = 0; x < transmission_.cols; ++x) {
      const double distance = std::min(1.0, std::hypot(x - cx, y - cy) / radius_px);
      const double inside = 1.0 - distance * distance * (3.0 - 2.0 * distance);
      transmission_.at<float>(y, x) *= static_cast<float>(1.0 - speck.opacity * inside);
    }
  }
}

cv::Mat ImageSensor::expose(const cv::Mat& light, std::uint64_t noise_key, double amplifier) const {
  const auto& table = normalTable();
  const auto gain = static_cast<float>(response_.gain), offset = static_cast<float>(response_.offset);
  const auto amplify = static_cast<float>(amplifier);
  const auto read2 = static_cast<float>(sensor_.read_noise * sensor_.read_noise);
  const auto shot2 = static_cast<float>(sensor_.shot_noise * sensor_.shot_noise);
  cv::Mat signal(light.size(), CV_32FC1);
  std::uint64_t bits = 0;
  std::uint64_t counter = 0;
  for (int y = 0; y < light.rows; ++y) {
    const float* in = light.ptr<float>(y);
    const float* factor = transmission_.ptr<float>(y);
    float* out = signal.ptr<float>(y);
    for (int x = 0; x < light.cols; ++x) {
      if (counter % 4 == 0) bits = mixBits(noise_key + counter);  // four draws of 12 bits each
      const float noise = table[(bits >> (12 * (counter % 4))) % kTableSize];
      ++counter;
      const float grey = gain * factor[x] * in[x] + offset;
      out[x] = amplify * (grey + noise * std::sqrt(read2 + shot2 * std::max(grey, 0.0f)));
    }
  }
  return processing_.develop(signal);
}

}  // namespace stereo_nav::sim
