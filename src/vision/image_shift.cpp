#include "vision/image_shift.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::vision {

std::optional<cv::Point2f> coarseShift(const ImagePyramid& from, const ImagePyramid& to) {
  constexpr double kLeastLikeness = 0.5;
  const int level = std::min(from.levels(), to.levels()) - 1;
  const cv::Mat& before = from.level(level);
  // The middle half of either side may be found anywhere in the other image.
  const cv::Rect middle(before.cols / 4, before.rows / 4, before.cols / 2, before.rows / 2);
  cv::Mat likeness;
  cv::matchTemplate(to.level(level), before(middle), likeness, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point place;
  cv::minMaxLoc(likeness, nullptr, &best, nullptr, &place);
  if (!(best >= kLeastLikeness)) return std::nullopt;
  const auto scale = static_cast<float>(1 << level);
  return scale * cv::Point2f(static_cast<float>(place.x - middle.x), static_cast<float>(place.y - middle.y));
}

}  // namespace stereo_nav::vision
