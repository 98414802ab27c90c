#include "vision/image_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::vision {
namespace {

cv::Mat withBorder(const cv::Size& size) {
  constexpr int kBorder = ImagePyramid::kBorder_px;
  cv::Mat padded(size.height + 2 * kBorder, size.width + 2 * kBorder, CV_8UC1);
  return padded(cv::Rect(kBorder, kBorder, size.width, size.height));
}

/// `level` is the inner part of its own memory, so only the border is written.
void fillBorder(cv::Mat level) {
  constexpr int kBorder = ImagePyramid::kBorder_px;
  const cv::Mat inner = level;
  level.adjustROI(kBorder, kBorder, kBorder, kBorder);
  cv::copyMakeBorder(inner, level, kBorder, kBorder, kBorder, kBorder,
                     cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
}

}  // namespace

ImagePyramid::ImagePyramid(const cv::Mat& image, int levels) {
  constexpr int kSmallestSide_px = 24;
  for (int l = 0; l < levels; ++l) {
    const cv::Size size =
        l == 0 ? image.size() : cv::Size((levels_.back().cols + 1) / 2, (levels_.back().rows + 1) / 2);
    if (l > 0 && std::min(size.width, size.height) < kSmallestSide_px) break;
    cv::Mat level = withBorder(size);
    if (l == 0) {
      image.copyTo(level);
    } else {
      cv::pyrDown(levels_.back(), level, size);
    }
    fillBorder(level);
    levels_.push_back(level);
  }
}

}  // namespace stereo_nav::vision
