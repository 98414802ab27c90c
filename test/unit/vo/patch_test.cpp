#include "stereo_nav/vo/patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stereo_nav/vo/image_pyramid.h"
#include "stereo_nav/vo/image_shift.h"
#include "stereo_nav/vo/patch_tracker.h"

namespace stereo_nav::vo {
namespace {

/// A smooth texture without repetition, moved by `shift`, zoomed about (100, 80), with gain and offset.
cv::Mat texture(const cv::Point2d& shift, double zoom = 1.0, double gain = 1.0, double offset = 0.0) {
  cv::Mat image(160, 200, CV_8UC1);
  for (int r = 0; r < image.rows; ++r) {
    for (int c = 0; c < image.cols; ++c) {
      const double x = 100.0 + (c - shift.x - 100.0) / zoom;
      const double y = 80.0 + (r - shift.y - 80.0) / zoom;
      const double value = 110.0 + 30.0 * std::sin(0.31 * x + 0.017 * y * y / 10.0) +
                           30.0 * std::cos(0.27 * y - 0.011 * x * x / 10.0) + 20.0 * std::sin(0.11 * (x + y));
      image.at<uchar>(r, c) = cv::saturate_cast<uchar>(gain * value + offset);
    }
  }
  return image;
}

TEST(PatchTest, FindsASubPixelShift) {
  const ImagePyramid before(texture({0.0, 0.0}), 3);
  const ImagePyramid after(texture({3.3, -2.6}), 3);
  const PatchTracker tracker{PatchTrackerParams()};
  const auto match = tracker.track(before, {100.0F, 80.0F}, after, {100.0F, 80.0F}, 2);
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->px.x, 103.3, 0.03);
  EXPECT_NEAR(match->px.y, 77.4, 0.03);
  EXPECT_GT(match->correlation, 0.99F);
}

TEST(PatchTest, IsIndifferentToGainAndOffset) {
  const ImagePyramid before(texture({0.0, 0.0}), 3);
  const ImagePyramid after(texture({1.4, 0.7}, 1.0, 0.5, 60.0), 3);
  const PatchTracker tracker{PatchTrackerParams()};
  const auto match = tracker.track(before, {90.0F, 70.0F}, after, {90.0F, 70.0F}, 1);
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->px.x, 91.4, 0.05);
  EXPECT_NEAR(match->px.y, 70.7, 0.05);
}

TEST(PatchTest, AWarpedPatchFitsAZoomedImage) {
  const ImagePyramid before(texture({0.0, 0.0}), 1);
  const ImagePyramid after(texture({0.0, 0.0}, 1.25), 1);
  const Eigen::Matrix2f step = Eigen::Matrix2f::Identity() / 1.25F;
  const auto plain = Patch::cut(before.level(0), {100.0F, 80.0F}, 15, 0.0);
  const auto warped = Patch::cut(before.level(0), {100.0F, 80.0F}, 15, 0.0, step);
  ASSERT_TRUE(plain && warped);
  EXPECT_GT(warped->correlation(after.level(0), 100, 80), 0.995F);
  EXPECT_GT(warped->correlation(after.level(0), 100, 80), plain->correlation(after.level(0), 100, 80));
}

TEST(PatchTest, RefusesWhatHasNoTexture) {
  const ImagePyramid flat(cv::Mat(100, 100, CV_8UC1, cv::Scalar(90)), 1);
  EXPECT_FALSE(Patch::cut(flat.level(0), {50.0F, 50.0F}, 11, 1.0));
  // An edge has no position along itself.
  cv::Mat edge(100, 100, CV_8UC1, cv::Scalar(20));
  edge.colRange(50, 100).setTo(200);
  EXPECT_FALSE(Patch::cut(ImagePyramid(edge, 1).level(0), {50.0F, 50.0F}, 11, 1.0));
}

TEST(PatchTest, StaysInTheImage) {
  const ImagePyramid image(texture({0.0, 0.0}), 1);
  EXPECT_FALSE(Patch::cut(image.level(0), {-3.0F, 50.0F}, 11, 0.0));
  EXPECT_FALSE(Patch::cut(image.level(0), {std::nanf(""), 50.0F}, 11, 0.0));
  const auto patch = Patch::cut(image.level(0), {4.0F, 4.0F}, 21, 0.0);
  ASSERT_TRUE(patch) << "patches may hang over the edge";
  EXPECT_FALSE(patch->align(image.level(0), {500.0F, 4.0F}, 10, 0.01));
}

TEST(ImagePyramidTest, HalvesDownToASmallestSide) {
  const ImagePyramid pyramid(texture({0.0, 0.0}), 8);
  ASSERT_EQ(pyramid.levels(), 3);  // 200x160, 100x80, 50x40; 25x20 would be too low
  EXPECT_EQ(pyramid.level(2).size(), cv::Size(50, 40));
}

TEST(ImageShiftTest, FindsHowFarThePictureMoved) {
  const ImagePyramid before(texture({0.0, 0.0}), 3);
  const auto shift = coarseShift(before, ImagePyramid(texture({24.0, -12.0}), 3));
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->x, 24.0, 4.0);
  EXPECT_NEAR(shift->y, -12.0, 4.0);
  EXPECT_FALSE(coarseShift(before, ImagePyramid(cv::Mat(160, 200, CV_8UC1, cv::Scalar(0)), 3)));
}

}  // namespace
}  // namespace stereo_nav::vo
