#pragma once

#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace stereo_nav::tools {

/// Two images of grey levels side by side with lines between their matches, first the query; CV_8UC3.
cv::Mat pairPicture(const cv::Mat& query, const cv::Mat& place,
                    const std::vector<std::pair<cv::Point2f, cv::Point2f>>& matches);

}  // namespace stereo_nav::tools
