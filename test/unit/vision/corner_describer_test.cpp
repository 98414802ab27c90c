#include "vision/corner_describer.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "support/textured_room.h"

namespace stereo_nav::vision {
namespace {

cv::Mat roomImage() {
  const StereoCalibration camera = test::roomCalibration();
  return test::TexturedRoom().render(test::roomDrive(0.0), camera.fx, camera.fy, camera.cx, camera.cy,
                                     {camera.width, camera.height});
}

TEST(DescriptorTest, DistanceIsTheNumberOfBitsThatDiffer) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 100; ++run) {
    const Descriptor a{random(), random(), random(), random()}, b{random(), random(), random(), random()};
    int bits = 0;
    for (int i = 0; i < kDescriptorBits; ++i) bits += bitOf(a, i) != bitOf(b, i) ? 1 : 0;
    EXPECT_EQ(hammingDistance(a, b), bits);
  }
  const Descriptor none{}, all{~0ULL, ~0ULL, ~0ULL, ~0ULL};
  EXPECT_EQ(hammingDistance(none, all), kDescriptorBits);
  EXPECT_EQ(hammingDistance(all, all), 0);
}

TEST(CornerDescriberTest, TheCentroidLiesWhereItIsBright) {
  cv::Mat image(60, 60, CV_8UC1, cv::Scalar(20));
  image.colRange(31, 60).setTo(220);
  EXPECT_NEAR(centroidDirection_deg(image, {30.0F, 30.0F}), 0.0F, 1.0F);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  EXPECT_NEAR(centroidDirection_deg(turned, {29.0F, 30.0F}), 90.0F, 5.0F);
}

/// What OpenCV would not do: a corner that it has not detected is described along its own direction.
TEST(CornerDescriberTest, ACornerIsKnownAgainInATurnedImageAndFromNearer) {
  const cv::Mat image = roomImage();
  const auto found = detectAndDescribe(image, 60, 10);
  std::vector<cv::Point2f> corners, turned_corners, nearer_corners;
  for (const cv::Point2f& px : found.px) {
    const cv::Point2f whole(std::round(px.x), std::round(px.y));
    corners.push_back(whole);
    turned_corners.emplace_back(static_cast<float>(image.rows - 1) - whole.y, whole.x);
    nearer_corners.emplace_back(1.5F * whole);
  }
  ASSERT_GT(corners.size(), 40u);
  cv::Mat turned, nearer;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  cv::resize(image, nearer, {}, 1.5, 1.5, cv::INTER_LINEAR);
  const auto described = describeCorners(image, corners);
  const auto after_turn = describeCorners(turned, turned_corners);
  const auto from_nearer = describeCorners(nearer, nearer_corners);
  const std::size_t n = corners.size();
  ASSERT_EQ(described.size(), 2 * n);
  int known_after_turn = 0, known_from_nearer = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (hammingDistance(described[i], after_turn[i]) <= 50) ++known_after_turn;
    if (hammingDistance(described[i], from_nearer[n + i]) <= 50) ++known_from_nearer;
  }
  EXPECT_GT(known_after_turn, static_cast<int>(0.85 * static_cast<double>(n)));
  EXPECT_GT(known_from_nearer, static_cast<int>(0.8 * static_cast<double>(n)));
}

TEST(CornerDescriberTest, CornersAtTheEdgeAreDescribedToo) {
  const cv::Mat image = roomImage();
  const std::vector<cv::Point2f> corners{
      {0.0F, 0.0F},
      {static_cast<float>(image.cols) - 0.6F, 3.0F},
      {static_cast<float>(image.cols - 1), static_cast<float>(image.rows - 1)}};
  EXPECT_EQ(describeCorners(image, corners).size(), 2 * corners.size());
  EXPECT_TRUE(describeCorners(image, {}).empty());
  EXPECT_TRUE(detectAndDescribe(cv::Mat(100, 100, CV_8UC1, cv::Scalar(90)), 100, 5).px.empty())
      << "a blank wall";
}

}  // namespace
}  // namespace stereo_nav::vision
