#include "vision/bit_depth.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace stereo_nav::vision {
namespace {

/// Exchanged bytes turn the noise of the lowest bits into the largest steps: natural images differ by a
/// factor of ten and more.
constexpr double kSmoother = 0.5;

int exchanged(int value) {
  return ((value & 0xff) << 8) | (value >> 8);
}

}  // namespace

void BitDepthFinder::add(const cv::Mat& image) {
  if (image.type() != CV_16UC1) return;
  has_images_ = true;
  for (int y = 0; y < image.rows; ++y) {
    const auto* row = image.ptr<std::uint16_t>(y);
    for (int x = 0; x < image.cols; ++x) {
      largest_ = std::max<int>(largest_, row[x]);
      largest_swapped_ = std::max(largest_swapped_, exchanged(row[x]));
      if (x == 0) continue;
      roughness_ += std::abs(row[x] - row[x - 1]);
      roughness_swapped_ += std::abs(exchanged(row[x]) - exchanged(row[x - 1]));
    }
  }
}

bool BitDepthFinder::swapped() const {
  return roughness_swapped_ < kSmoother * roughness_;
}

int BitDepthFinder::largest() const {
  return swapped() ? largest_swapped_ : largest_;
}

BitDepth BitDepthFinder::depth() const {
  if (!has_images_) return {};
  for (const int bits : {8, 10, 12, 14}) {
    if (largest() < (1 << bits)) return {bits, swapped()};
  }
  return {16, swapped()};
}

cv::Mat toFullRange(const cv::Mat& image, const BitDepth& depth) {
  cv::Mat result = image.clone();
  for (int y = 0; y < result.rows; ++y) {
    auto* row = result.ptr<std::uint16_t>(y);
    for (int x = 0; x < result.cols; ++x) {
      const int value = depth.swapped ? exchanged(row[x]) : row[x];
      row[x] = static_cast<std::uint16_t>(std::min(value << (16 - depth.bits), 0xffff));
    }
  }
  return result;
}

}  // namespace stereo_nav::vision
