#include "vision/patch_sampling.h"

#include <cmath>
#include <cstddef>
#include <opencv2/core/hal/intrin.hpp>

#include "vision/image_pyramid.h"

namespace stereo_nav::vision {
namespace {

constexpr int kWeightBits = 14;

}  // namespace

void sample(const cv::Mat& image, const cv::Point2f& corner, int rows, int stride, std::int16_t* out) {
  const int x = static_cast<int>(std::floor(corner.x));
  const int y = static_cast<int>(std::floor(corner.y));
  const float a = corner.x - static_cast<float>(x);
  const float b = corner.y - static_cast<float>(y);
  constexpr float kOne = 1 << kWeightBits;
  const auto w01 = static_cast<short>(std::lround(a * (1.0F - b) * kOne));
  const auto w10 = static_cast<short>(std::lround((1.0F - a) * b * kOne));
  const auto w11 = static_cast<short>(std::lround(a * b * kOne));
  const auto w00 = static_cast<short>((1 << kWeightBits) - w01 - w10 - w11);
  const cv::v_int16x8 upper(w00, w01, w00, w01, w00, w01, w00, w01);
  const cv::v_int16x8 lower(w10, w11, w10, w11, w10, w11, w10, w11);
  constexpr int kShift = kWeightBits - kFractionBits;
  const cv::v_int32x4 half = cv::v_setall_s32(1 << (kShift - 1));
  const auto step = static_cast<std::ptrdiff_t>(image.step);
  const uchar* const first = image.data + y * step + x;
  for (int r = 0; r < rows; ++r) {
    const uchar* above = first + r * step;
    const uchar* below = above + step;
    for (int c = 0; c < stride; c += 8) {
      cv::v_int16x8 low;
      cv::v_int16x8 high;
      cv::v_zip(cv::v_reinterpret_as_s16(cv::v_load_expand(above + c)),
                cv::v_reinterpret_as_s16(cv::v_load_expand(above + c + 1)), low, high);
      cv::v_int32x4 sum_low = cv::v_dotprod(low, upper) + half;
      cv::v_int32x4 sum_high = cv::v_dotprod(high, upper) + half;
      cv::v_zip(cv::v_reinterpret_as_s16(cv::v_load_expand(below + c)),
                cv::v_reinterpret_as_s16(cv::v_load_expand(below + c + 1)), low, high);
      sum_low = cv::v_dotprod(low, lower) + sum_low;
      sum_high = cv::v_dotprod(high, lower) + sum_high;
      cv::v_store(out + r * stride + c, cv::v_pack(sum_low >> kShift, sum_high >> kShift));
    }
  }
}

bool warpInside(const cv::Mat& image, const cv::Point2f& centre, const Eigen::Matrix2f& step, int half) {
  constexpr auto kBorder = static_cast<float>(ImagePyramid::kBorder_px - 1);
  const Eigen::Vector2f reach = static_cast<float>(half) * step.cwiseAbs().rowwise().sum();
  return centre.x - reach.x() >= -kBorder && centre.y - reach.y() >= -kBorder &&
         centre.x + reach.x() <= static_cast<float>(image.cols - 2) + kBorder &&
         centre.y + reach.y() <= static_cast<float>(image.rows - 2) + kBorder;
}

void sampleWarped(const cv::Mat& image, const cv::Point2f& centre, const Eigen::Matrix2f& step, int half,
                  int stride, std::int16_t* out) {
  constexpr int kBits = 16;
  constexpr float kOne = 1 << kBits;
  constexpr int kShare = 128;  // 7 bits of the fraction: products stay below 2^31
  const auto fixed = [](float value) { return static_cast<int>(std::lround(value * kOne)); };
  const auto pitch = static_cast<std::ptrdiff_t>(image.step);
  const int column_x = fixed(step(0, 0));
  const int column_y = fixed(step(1, 0));
  const int size = 2 * half + 1;
  for (int r = 0; r < size; ++r) {
    const auto dy = static_cast<float>(r - half);
    const auto dx = static_cast<float>(-half);
    int x = fixed(centre.x + step(0, 0) * dx + step(0, 1) * dy);
    int y = fixed(centre.y + step(1, 0) * dx + step(1, 1) * dy);
    for (int c = 0; c < size; ++c, x += column_x, y += column_y) {
      // Arithmetic shifts round down, also for the negative places of the border.
      const uchar* above = image.data + static_cast<std::ptrdiff_t>(y >> kBits) * pitch + (x >> kBits);
      const uchar* below = above + pitch;
      const int a = (x >> (kBits - 7)) & (kShare - 1);
      const int b = (y >> (kBits - 7)) & (kShare - 1);
      const int upper = above[0] * (kShare - a) + above[1] * a;
      const int lower = below[0] * (kShare - a) + below[1] * a;
      constexpr int kShift = 14 - kFractionBits;
      out[r * stride + c] =
          static_cast<std::int16_t>((upper * (kShare - b) + lower * b + (1 << (kShift - 1))) >> kShift);
    }
  }
}

}  // namespace stereo_nav::vision
