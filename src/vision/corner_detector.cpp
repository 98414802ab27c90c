#include "vision/corner_detector.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::vision {
namespace {

/// A total order, so that equal responses do not depend on the order of detection.
bool stronger(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  if (a.response != b.response) return a.response > b.response;
  if (a.pt.y != b.pt.y) return a.pt.y < b.pt.y;
  return a.pt.x < b.pt.x;
}

}  // namespace

void CornerDetectorParams::describe(ParameterVisitor& visitor) {
  visitor.integer("rows", rows, {1, 64}, "", "rows of buckets");
  visitor.integer("columns", columns, {1, 64}, "", "columns of buckets");
  visitor.integer("per_bucket", per_bucket, {1, 1000}, "",
                  "corners kept in each bucket, the strongest first");
  visitor.integer("threshold", threshold, {1, 254}, "grey levels", "FAST threshold");
}

CornerDetector::CornerDetector(const CornerDetectorParams& params) : params_(params) {
  validateParameters(params, "corners");
}

std::vector<cv::Point2f> CornerDetector::detect(const cv::Mat& image) const {
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image, corners, params_.threshold, true);

  std::vector<std::vector<cv::KeyPoint>> buckets(static_cast<std::size_t>(params_.rows * params_.columns));
  for (const auto& corner : corners) {
    const int row = std::min(static_cast<int>(corner.pt.y) * params_.rows / image.rows, params_.rows - 1);
    const int column =
        std::min(static_cast<int>(corner.pt.x) * params_.columns / image.cols, params_.columns - 1);
    buckets[static_cast<std::size_t>(row * params_.columns + column)].push_back(corner);
  }

  std::vector<cv::Point2f> kept;
  for (auto& bucket : buckets) {
    const auto count = std::min(bucket.size(), static_cast<std::size_t>(params_.per_bucket));
    const auto end = bucket.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(bucket.begin(), end, bucket.end(), stronger);
    std::transform(bucket.begin(), end, std::back_inserter(kept),
                   [](const cv::KeyPoint& corner) { return corner.pt; });
  }
  return kept;
}

}  // namespace stereo_nav::vision
