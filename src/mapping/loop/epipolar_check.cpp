#include "mapping/loop/epipolar_check.h"

#include <opencv2/calib3d.hpp>

namespace stereo_nav::mapping {

std::vector<CornerMatch> epipolarInliers(const std::vector<cv::Point2f>& query_px,
                                         const std::vector<cv::Point2f>& place_px,
                                         const std::vector<CornerMatch>& matches, double max_error_px) {
  constexpr std::size_t kFewest = 8;
  constexpr double kConfidence = 0.999;
  if (matches.size() < kFewest) return {};
  std::vector<cv::Point2f> query, place;
  for (const CornerMatch& match : matches) {
    query.push_back(query_px[match.query]);
    place.push_back(place_px[match.place]);
  }
  std::vector<std::uint8_t> agrees;
  cv::findFundamentalMat(query, place, cv::FM_RANSAC, max_error_px, kConfidence, agrees);
  std::vector<CornerMatch> inliers;
  for (std::size_t i = 0; i < agrees.size(); ++i) {
    if (agrees[i] != 0) inliers.push_back(matches[i]);
  }
  return inliers;
}

}  // namespace stereo_nav::mapping
