#include "vision/corner_detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::vision {
namespace {

/// Bright squares on black; FAST responds at their corners.
cv::Mat squares(const std::vector<cv::Rect>& rectangles, int grey = 255) {
  cv::Mat image(200, 500, CV_8UC1, cv::Scalar(0));
  for (const auto& rectangle : rectangles) cv::rectangle(image, rectangle, cv::Scalar(grey), cv::FILLED);
  // Blurred as by a lens: on perfect edges neighbours are equal, and non-maximum suppression drops both.
  cv::GaussianBlur(image, image, cv::Size(5, 5), 0.8);
  return image;
}

TEST(CornerDetector, FindsNothingInAnEmptyImage) {
  EXPECT_TRUE(CornerDetector({}).detect(squares({})).empty());
}

TEST(CornerDetector, FindsTheFourCornersOfASquare) {
  CornerDetectorParams params;
  params.rows = params.columns = 1;
  const auto corners = CornerDetector(params).detect(squares({{220, 80, 40, 40}}));
  for (const cv::Point2f expected : {cv::Point2f(220, 80), {259, 80}, {220, 119}, {259, 119}}) {
    const bool found = std::any_of(corners.begin(), corners.end(), [&](const cv::Point2f& corner) {
      return cv::norm(corner - expected) < 2.0;
    });
    EXPECT_TRUE(found) << expected;
  }
}

TEST(CornerDetector, KeepsAtMostSoManyInEachBucketAndFillsAllOfThem) {
  cv::Mat image(200, 500, CV_8UC1);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, cv::Size(5, 5), 1.2);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  const CornerDetectorParams params;  // 2 x 5, 15 each
  const auto corners = CornerDetector(params).detect(image);
  std::vector<int> counts(10, 0);
  for (const auto& corner : corners) {
    ++counts[static_cast<std::size_t>(static_cast<int>(corner.y) / 100 * 5 +
                                      static_cast<int>(corner.x) / 100)];
  }
  for (const int count : counts) EXPECT_EQ(count, 15);
}

TEST(CornerDetector, PrefersTheStrongerCorner) {
  CornerDetectorParams params;
  params.rows = params.columns = params.per_bucket = 1;
  const cv::Mat image = squares({{50, 50, 40, 40}}, 90) + squares({{300, 50, 40, 40}}, 250);
  const auto corners = CornerDetector(params).detect(image);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_GT(corners[0].x, 290.0F);
}

TEST(CornerDetector, RefusesImpossibleParameters) {
  CornerDetectorParams params;
  params.threshold = 0;
  EXPECT_THROW(CornerDetector{params}, ParameterError);
}

}  // namespace
}  // namespace stereo_nav::vision
