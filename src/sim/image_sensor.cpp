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
    : sensor_(sensor), response_(response), vignetting_(height, width, CV_32FC1) {
  const double cx = 0.5 * (width - 1), cy = 0.5 * (height - 1), corner2 = cx * cx + cy * cy;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double r2 = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / corner2;
      vignetting_.at<float>(y, x) = static_cast<float>(1.0 - sensor.vignetting * r2);
    }
  }
}

cv::Mat ImageSensor::expose(const cv::Mat& light, std::uint64_t noise_key) const {
  const auto& table = normalTable();
  const auto gain = static_cast<float>(response_.gain), offset = static_cast<float>(response_.offset);
  const auto read2 = static_cast<float>(sensor_.read_noise * sensor_.read_noise);
  const auto shot2 = static_cast<float>(sensor_.shot_noise * sensor_.shot_noise);
  cv::Mat image(light.size(), CV_8UC1);
  std::uint64_t bits = 0;
  std::uint64_t counter = 0;
  for (int y = 0; y < light.rows; ++y) {
    const float* in = light.ptr<float>(y);
    const float* factor = vignetting_.ptr<float>(y);
    std::uint8_t* out = image.ptr<std::uint8_t>(y);
    for (int x = 0; x < light.cols; ++x) {
      if (counter % 4 == 0) bits = mixBits(noise_key + counter);  // four draws of 12 bits each
      const float noise = table[(bits >> (12 * (counter % 4))) % kTableSize];
      ++counter;
      const float grey = gain * factor[x] * in[x] + offset;
      const float value = grey + noise * std::sqrt(read2 + shot2 * std::max(grey, 0.0f));
      out[x] = static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
    }
  }
  return image;
}

void SensorParams::describe(ParameterVisitor& visitor) {
  visitor.real("exposure_ms", exposure_ms, {0.0, 100.0}, "ms", "time over which an image is collected");
  visitor.real("rolling_shutter_ms", rolling_shutter_ms, {0.0, 100.0}, "ms",
               "from the first row's exposure to the last one's; 0 is a global shutter");
  visitor.real("read_noise", read_noise, {0.0, 50.0}, "grey levels", "standard deviation in the dark");
  visitor.real("shot_noise", shot_noise, {0.0, 5.0}, "grey levels",
               "standard deviation at grey level 1; grows with the root");
  visitor.real("vignetting", vignetting, {0.0, 1.0}, "", "light lost in the corners");
}

void CameraResponse::describe(ParameterVisitor& visitor) {
  visitor.real("gain", gain, {0.0, 10.0}, "",
               "factor on the light; 1 shows a material's brightness as it is");
  visitor.real("offset", offset, {-100.0, 100.0}, "grey levels", "black level");
}

}  // namespace stereo_nav::sim
