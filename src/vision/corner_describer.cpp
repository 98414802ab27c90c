#include "vision/corner_describer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::vision {
namespace {

constexpr int kPatch_px = 31;
constexpr int kRadius_px = kPatch_px / 2;
constexpr int kNoEdge_px = 0;  ///< OpenCV mirrors the image at its edges

/// Half of the width of each row of the circle.
std::array<int, kRadius_px + 1> rowsOfCircle() {
  std::array<int, kRadius_px + 1> half_width{};
  for (int y = 0; y <= kRadius_px; ++y)
    half_width[static_cast<std::size_t>(y)] =
        static_cast<int>(std::lround(std::sqrt(kRadius_px * kRadius_px - y * y)));
  return half_width;
}

std::vector<Descriptor> toDescriptors(const cv::Mat& rows) {
  std::vector<Descriptor> descriptors(static_cast<std::size_t>(rows.rows));
  for (int i = 0; i < rows.rows; ++i)
    std::memcpy(descriptors[static_cast<std::size_t>(i)].data(), rows.ptr(i), sizeof(Descriptor));
  return descriptors;
}

std::vector<Descriptor> describeAtOneScale(const cv::Mat& image, const std::vector<cv::Point2f>& corners,
                                           double scale) {
  std::vector<cv::KeyPoint> keypoints;
  keypoints.reserve(corners.size());
  for (const cv::Point2f& corner : corners) {
    // The last pixel of a smaller image may lie just inside of where the corner comes to lie.
    const cv::Point2f px(std::min(static_cast<float>(corner.x / scale), static_cast<float>(image.cols - 1)),
                         std::min(static_cast<float>(corner.y / scale), static_cast<float>(image.rows - 1)));
    keypoints.emplace_back(px, static_cast<float>(kPatch_px), centroidDirection_deg(image, px));
    keypoints.back().octave = 0;
  }
  const auto orb = cv::ORB::create(static_cast<int>(corners.size()), 1.2F, 1, kNoEdge_px, 0, 2,
                                   cv::ORB::HARRIS_SCORE, kPatch_px);
  cv::Mat rows;
  orb->compute(image, keypoints, rows);
  return toDescriptors(rows);
}

}  // namespace

float centroidDirection_deg(const cv::Mat& image, const cv::Point2f& corner) {
  static const auto kHalfWidth = rowsOfCircle();
  const int centre_x = cvRound(corner.x), centre_y = cvRound(corner.y);
  int moment_x = 0, moment_y = 0;
  for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
    const int y = centre_y + dy;
    if (y < 0 || y >= image.rows) continue;
    const int half = kHalfWidth[static_cast<std::size_t>(std::abs(dy))];
    const int from = std::max(-half, -centre_x), to = std::min(half, image.cols - 1 - centre_x);
    const auto* row = image.ptr<std::uint8_t>(y) + centre_x;
    int sum = 0;
    for (int dx = from; dx <= to; ++dx) {
      moment_x += dx * row[dx];
      sum += row[dx];
    }
    moment_y += dy * sum;
  }
  return cv::fastAtan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

std::vector<Descriptor> describeCorners(const cv::Mat& image, const std::vector<cv::Point2f>& corners) {
  std::vector<Descriptor> descriptors;
  if (corners.empty()) return descriptors;
  for (const double scale : kDescriptorScales) {
    cv::Mat scaled = image;
    if (scale != 1.0) cv::resize(image, scaled, {}, 1.0 / scale, 1.0 / scale, cv::INTER_LINEAR);
    const std::vector<Descriptor> at_scale = describeAtOneScale(scaled, corners, scale);
    descriptors.insert(descriptors.end(), at_scale.begin(), at_scale.end());
  }
  return descriptors;
}

DescribedCorners detectAndDescribe(const cv::Mat& image, int most, int threshold) {
  constexpr int kLevels = 8;
  const auto orb =
      cv::ORB::create(most, 1.2F, kLevels, kPatch_px, 0, 2, cv::ORB::HARRIS_SCORE, kPatch_px, threshold);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat rows;
  orb->detectAndCompute(image, cv::noArray(), keypoints, rows);
  DescribedCorners corners;
  for (const cv::KeyPoint& keypoint : keypoints) corners.px.push_back(keypoint.pt);
  corners.descriptors = toDescriptors(rows);
  return corners;
}

}  // namespace stereo_nav::vision
