#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "mapping/loop/descriptor_matching.h"

namespace stereo_nav::mapping {

/// Of the matches of two images of one camera, whose calibration need not be known, those that agree with one
/// fundamental matrix: their distance from the epipolar lines is at most `max_error_px`. By RANSAC with a
/// counted number of samples and a fixed seed (OpenCV's). Two views of like places agree by chance in more
/// matches than stereo does: an epipolar line leaves one coordinate free.
std::vector<CornerMatch> epipolarInliers(const std::vector<cv::Point2f>& query_px,
                                         const std::vector<cv::Point2f>& place_px,
                                         const std::vector<CornerMatch>& matches, double max_error_px);

}  // namespace stereo_nav::mapping
