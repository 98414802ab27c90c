#include "vision/patch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/patch_sampling.h"

namespace stereo_nav::vision {
namespace {

constexpr float kNoWarp = 0.02F;  ///< less than this changes a patch by a fraction of a pixel at its rim
constexpr float kLeastGain = 0.25F;
constexpr float kMostGain = 4.0F;

/// Patches may hang over the edge of the image into the border of its pyramid, but not by half.
bool inside(const cv::Mat& image, const cv::Point2f& centre) {
  constexpr float kMargin_px = 2.0F;
  // Written so that NaN is outside.
  return centre.x >= kMargin_px && centre.y >= kMargin_px &&
         centre.x <= static_cast<float>(image.cols - 1) - kMargin_px &&
         centre.y <= static_cast<float>(image.rows - 1) - kMargin_px;
}

/// Subtracts the mean over the window so that the integer sum is exactly zero; clears the padding.
void removeMean(std::int16_t* grid, const std::int16_t* mask, int window, int stride) {
  cv::v_int32x4 sums = cv::v_setzero_s32();
  for (int r = 0; r < window; ++r) {
    for (int c = 0; c < stride; c += 8)
      sums = cv::v_dotprod(cv::v_load(grid + r * stride + c), cv::v_load(mask + c), sums);
  }
  const int sum = cv::v_reduce_sum(sums);
  const int count = window * window;
  const int mean = sum >= 0 ? sum / count : -((count - 1 - sum) / count);
  int remainder = sum - mean * count;  // so many values, the first ones, become smaller by one more
  const cv::v_int16x8 means = cv::v_setall_s16(static_cast<short>(mean));
  for (int r = 0; r < window; ++r, remainder = std::max(0, remainder - window)) {
    for (int c = 0; c < stride; c += 8) {
      const cv::v_int16x8 place(0, 1, 2, 3, 4, 5, 6, 7);
      const cv::v_int16x8 one_less = place < cv::v_setall_s16(static_cast<short>(remainder - c));
      const cv::v_int16x8 value = cv::v_load(grid + r * stride + c) - means + one_less;
      cv::v_store(grid + r * stride + c, cv::v_mul_wrap(value, cv::v_load(mask + c)));
    }
  }
}

/// Half the difference, rounded towards zero.
cv::v_int16x8 halfDifference(const std::int16_t* after, const std::int16_t* before) {
  const cv::v_int16x8 difference = cv::v_load(after) - cv::v_load(before);
  return (difference - (difference >> 15)) >> 1;
}

float dot(const std::int16_t* a, const std::int16_t* b, int count) {
  cv::v_int32x4 sum = cv::v_setzero_s32();
  for (int i = 0; i < count; i += 8) sum = cv::v_dotprod(cv::v_load(a + i), cv::v_load(b + i), sum);
  return static_cast<float>(cv::v_reduce_sum(sum));
}

}  // namespace

struct Patch::Sums {
  float by_gradient_x = 0.0F;
  float by_gradient_y = 0.0F;
  float by_intensity = 0.0F;
  float sum = 0.0F;
  float squares = 0.0F;
};

std::optional<Patch> Patch::cut(const cv::Mat& image, const cv::Point2f& centre, int window,
                                double min_texture, const Eigen::Matrix2f& step) {
  const int half = window / 2;
  const int stride = (window + 7) / 8 * 8;
  if (!inside(image, centre)) return std::nullopt;
  Patch patch;
  patch.window_ = window;
  patch.stride_ = stride;
  const auto offset = static_cast<float>(half);
  const cv::Point2f corner = centre - cv::Point2f(offset, offset);
  alignas(16) std::array<std::int16_t, (kMaxStride + 8) * (kMaxWindow + 2)> wide;
  const int wide_stride = stride + 8;
  // One more pixel on every side for the gradients.
  if (step.isIdentity(kNoWarp)) {
    sample(image, corner - cv::Point2f(1.0F, 1.0F), window + 2, wide_stride, wide.data());
  } else {
    if (!warpInside(image, centre, step, half + 1)) return std::nullopt;
    wide.fill(0);
    sampleWarped(image, centre, step, half + 1, wide_stride, wide.data());
  }
  for (int r = 0; r < window; ++r) {
    const std::int16_t* row = wide.data() + (r + 1) * wide_stride + 1;
    for (int c = 0; c < stride; c += 8) {
      const int i = r * stride + c;
      cv::v_store(patch.intensity_.data() + i, cv::v_load(row + c));
      cv::v_store(patch.gradient_x_.data() + i, halfDifference(row + c + 1, row + c - 1));
      cv::v_store(patch.gradient_y_.data() + i, halfDifference(row + c + wide_stride, row + c - wide_stride));
    }
  }
  for (int c = 0; c < kMaxStride; ++c) patch.mask_[static_cast<std::size_t>(c)] = c < window ? 1 : 0;
  for (auto* grid : {&patch.intensity_, &patch.gradient_x_, &patch.gradient_y_})
    removeMean(grid->data(), patch.mask_.data(), window, stride);

  const int count = window * stride;
  const std::int16_t* const fields[] = {patch.gradient_x_.data(), patch.gradient_y_.data(),
                                        patch.intensity_.data()};
  Eigen::Matrix3f moments;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) moments(i, j) = moments(j, i) = dot(fields[i], fields[j], count);
  }
  const float unit = static_cast<float>(window * window) * (1 << kFractionBits) * (1 << kFractionBits);
  const float mean = 0.5F * (moments(0, 0) + moments(1, 1)) / unit;
  const float difference = 0.5F * (moments(0, 0) - moments(1, 1)) / unit;
  const float smaller_eigenvalue = mean - std::hypot(difference, moments(0, 1) / unit);
  if (smaller_eigenvalue < static_cast<float>(min_texture)) return std::nullopt;
  patch.inverse_moments_ = moments.inverse();
  if (!patch.inverse_moments_.allFinite()) return std::nullopt;
  patch.intensity_norm_ = std::sqrt(moments(2, 2));
  return patch;
}

Patch::Sums Patch::correlate(const Grid& grid) const {
  cv::v_int32x4 x = cv::v_setzero_s32();
  cv::v_int32x4 y = cv::v_setzero_s32();
  cv::v_int32x4 t = cv::v_setzero_s32();
  cv::v_int32x4 ones = cv::v_setzero_s32();
  cv::v_int32x4 squares = cv::v_setzero_s32();
  for (int r = 0; r < window_; ++r) {
    for (int c = 0; c < stride_; c += 8) {
      const int i = r * stride_ + c;
      const cv::v_int16x8 mask = cv::v_load_aligned(mask_.data() + c);
      const cv::v_int16x8 value = cv::v_load_aligned(grid.data() + i);
      x = cv::v_dotprod(value, cv::v_load_aligned(gradient_x_.data() + i), x);
      y = cv::v_dotprod(value, cv::v_load_aligned(gradient_y_.data() + i), y);
      t = cv::v_dotprod(value, cv::v_load_aligned(intensity_.data() + i), t);
      ones = cv::v_dotprod(value, mask, ones);
      squares = cv::v_dotprod(value, cv::v_mul_wrap(value, mask), squares);
    }
  }
  Sums sums;
  sums.by_gradient_x = static_cast<float>(cv::v_reduce_sum(x));
  sums.by_gradient_y = static_cast<float>(cv::v_reduce_sum(y));
  sums.by_intensity = static_cast<float>(cv::v_reduce_sum(t));
  sums.sum = static_cast<float>(cv::v_reduce_sum(ones));
  sums.squares = static_cast<float>(cv::v_reduce_sum(squares));
  return sums;
}

float Patch::correlation(const cv::Mat& image, int x, int y) const {
  cv::v_int32x4 product = cv::v_setzero_s32();
  cv::v_int32x4 ones = cv::v_setzero_s32();
  cv::v_int32x4 squares = cv::v_setzero_s32();
  const int half = window_ / 2;
  const auto step = static_cast<std::ptrdiff_t>(image.step);
  const uchar* row = image.data + (y - half) * step + x - half;
  for (int r = 0; r < window_; ++r, row += step) {
    for (int c = 0; c < stride_; c += 8) {
      const cv::v_int16x8 value = cv::v_reinterpret_as_s16(cv::v_load_expand(row + c));
      const cv::v_int16x8 mask = cv::v_load_aligned(mask_.data() + c);
      product = cv::v_dotprod(value, cv::v_load_aligned(intensity_.data() + r * stride_ + c), product);
      ones = cv::v_dotprod(value, mask, ones);
      squares = cv::v_dotprod(value, cv::v_mul_wrap(value, mask), squares);
    }
  }
  const auto sum = static_cast<float>(cv::v_reduce_sum(ones));
  const float variance =
      static_cast<float>(cv::v_reduce_sum(squares)) - sum * sum / static_cast<float>(window_ * window_);
  if (variance <= 0.0F) return 0.0F;
  return static_cast<float>(cv::v_reduce_sum(product)) / (intensity_norm_ * std::sqrt(variance));
}

std::optional<Patch::Match> Patch::align(const cv::Mat& image, const cv::Point2f& guess, int iterations,
                                         double min_step_px) const {
  constexpr float kLongestStep_px = 2.0F;
  alignas(16) Grid grid;
  const int half_window = window_ / 2;
  const auto half = static_cast<float>(half_window);
  Match match{guess, 0.0F, false};
  for (int i = 0; i < iterations && !match.converged; ++i) {
    if (!inside(image, match.px)) return std::nullopt;
    sample(image, match.px - cv::Point2f(half, half), window_, stride_, grid.data());
    const Sums sums = correlate(grid);
    const Eigen::Vector3f coefficients =
        inverse_moments_ * Eigen::Vector3f(sums.by_gradient_x, sums.by_gradient_y, sums.by_intensity);
    const float gain = coefficients.z();
    if (!(gain > kLeastGain && gain < kMostGain)) return std::nullopt;
    cv::Point2f step(-coefficients.x() / gain, -coefficients.y() / gain);
    const float length = std::hypot(step.x, step.y);
    if (length > kLongestStep_px) step *= kLongestStep_px / length;
    match.px += step;
    match.converged = length < static_cast<float>(min_step_px);
    const float variance = sums.squares - sums.sum * sums.sum / static_cast<float>(window_ * window_);
    match.correlation = variance > 0.0F ? sums.by_intensity / (intensity_norm_ * std::sqrt(variance)) : 0.0F;
    const cv::Point2f away = match.px - guess;
    if (std::hypot(away.x, away.y) > static_cast<float>(window_)) return std::nullopt;
  }
  if (!inside(image, match.px)) return std::nullopt;
  return match;
}

}  // namespace stereo_nav::vision
