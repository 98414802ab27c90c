#include "tools/depth_at/depth_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {

std::optional<double> medianDisparity(const cv::Mat& window) {
  std::vector<float> values;
  for (const float value : cv::Mat_<float>(window)) {
    if (value > 0.0f) values.push_back(value);
  }
  if (values.empty() || 2 * values.size() < window.total()) return std::nullopt;
  return upperMedian(values);
}

cv::Rect windowAround(cv::Point pixel, int size, cv::Size image) {
  const cv::Rect window(pixel.x - size / 2, pixel.y - size / 2, size, size);
  if ((window & cv::Rect({0, 0}, image)) == window) return window;
  throw InputError("the window of " + std::to_string(size) + " px around pixel (" + std::to_string(pixel.x) +
                   ", " + std::to_string(pixel.y) + ") leaves the image of " + std::to_string(image.width) +
                   " x " + std::to_string(image.height));
}

void DepthStatistics::add(std::optional<double> depth_m) {
  ++frames_;
  if (depth_m) depths_m_.push_back(*depth_m);
}

std::string DepthStatistics::text() const {
  if (depths_m_.empty()) {
    return fmt::format(
        "no disparity at the pixel in any of {} frames: too near for the range searched, hidden from the "
        "right camera, or without texture",
        frames_);
  }
  double sum = 0.0, squares = 0.0;
  for (const double depth_m : depths_m_) sum += depth_m;
  const double n = static_cast<double>(depths_m_.size()), mean = sum / n;
  for (const double depth_m : depths_m_) squares += (depth_m - mean) * (depth_m - mean);
  const auto [least, most] = std::minmax_element(depths_m_.begin(), depths_m_.end());
  return fmt::format(
      "mean {:.3f} m, standard deviation {:.3f} m, from {:.3f} to {:.3f} m, in {} of {} frames", mean,
      std::sqrt(squares / n), *least, *most, depths_m_.size(), frames_);
}

}  // namespace stereo_nav::tools
