#include "tools/find_loops/pair_picture.h"

#include <opencv2/imgproc.hpp>

namespace stereo_nav::tools {

cv::Mat pairPicture(const cv::Mat& query, const cv::Mat& place,
                    const std::vector<std::pair<cv::Point2f, cv::Point2f>>& matches) {
  cv::Mat both, picture;
  cv::hconcat(query, place, both);
  cv::cvtColor(both, picture, cv::COLOR_GRAY2BGR);
  const cv::Point2f shift(static_cast<float>(query.cols), 0.0F);
  constexpr int kRadius_px = 3;
  for (const auto& [in_query, in_place] : matches) {
    const cv::Scalar green(0, 220, 0);
    cv::line(picture, in_query, in_place + shift, green, 1, cv::LINE_AA);
    cv::circle(picture, in_query, kRadius_px, green, 1, cv::LINE_AA);
    cv::circle(picture, in_place + shift, kRadius_px, green, 1, cv::LINE_AA);
  }
  return picture;
}

}  // namespace stereo_nav::tools
