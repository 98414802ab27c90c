#include "vision/klt_tracker.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace stereo_nav::vision {
namespace {

cv::Mat texture() {
  cv::Mat image(240, 320, CV_8UC1);
  cv::RNG random(11);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, cv::Size(9, 9), 2.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

TEST(KltTracker, FollowsAShiftToATenthOfAPixel) {
  const cv::Mat previous = texture();
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 7.3, 0, 1, -4.6);
  cv::Mat current;
  cv::warpAffine(previous, current, shift, previous.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  const std::vector<cv::Point2f> points = {{100, 100}, {200, 60}, {160, 180}, {60, 200}};
  const auto tracks = KltTracker({}).track(previous, current, points);
  ASSERT_EQ(tracks.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(tracks[i].found);
    EXPECT_NEAR(tracks[i].position.x, points[i].x + 7.3F, 0.1);
    EXPECT_NEAR(tracks[i].position.y, points[i].y - 4.6F, 0.1);
  }
}

TEST(KltTracker, APointThatLeavesTheImageIsNotFound) {
  const cv::Mat previous = texture();
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 12, 0, 1, 0);
  cv::Mat current;
  cv::warpAffine(previous, current, shift, previous.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  const auto tracks = KltTracker({}).track(previous, current, {{312.0F, 120.0F}});
  EXPECT_FALSE(tracks[0].found);
}

TEST(KltTracker, WithoutTextureNothingIsFound) {
  const cv::Mat blank(240, 320, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(KltTracker({}).track(blank, blank, {{100.0F, 100.0F}})[0].found);
}

TEST(KltTracker, NoPointsNoTracks) {
  EXPECT_TRUE(KltTracker({}).track(texture(), texture(), {}).empty());
}

}  // namespace
}  // namespace stereo_nav::vision
