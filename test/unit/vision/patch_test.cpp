#include "vision/patch.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vision/image_pyramid.h"
#include "vision/image_shift.h"
#include "vision/patch_tracker.h"

namespace stereo_nav::vision {
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

/// A second implementation of Patch, value by value, which rounds only where the definition rounds.
class PlainPatch {
 public:
  using Grid = std::vector<int>;  ///< eighths of a grey level, row by row

  PlainPatch(const cv::Mat& image, const cv::Point2f& centre, int window) : window_(window) {
    const int half = window / 2;
    const auto offset = static_cast<float>(half + 1);
    const int wide = window + 2;
    const Grid grey = sampled(image, centre - cv::Point2f(offset, offset), wide);
    for (int r = 1; r <= window; ++r) {
      for (int c = 1; c <= window; ++c) {
        const auto i = static_cast<std::size_t>(r * wide + c);
        const auto row = static_cast<std::size_t>(wide);
        fields_[0].push_back((grey[i + 1] - grey[i - 1]) / 2);  // C++ rounds towards zero
        fields_[1].push_back((grey[i + row] - grey[i - row]) / 2);
        fields_[2].push_back(grey[i]);
      }
    }
    for (Grid& field : fields_) removeMean(field);
    Eigen::Matrix3f moments;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) moments(i, j) = dot(fields_.at(i), fields_.at(j));
    }
    inverse_moments_ = moments.inverse();
    norm_ = std::sqrt(moments(2, 2));
  }

  /// One step of Patch::align, no longer than 2 px.
  Patch::Match step(const cv::Mat& image, const cv::Point2f& guess) const {
    const auto half = static_cast<float>(window_ / 2);
    const Grid seen = sampled(image, guess - cv::Point2f(half, half), window_);
    const float product = dot(seen, fields_[2]);
    const Eigen::Vector3f coefficients =
        inverse_moments_ * Eigen::Vector3f(dot(seen, fields_[0]), dot(seen, fields_[1]), product);
    const cv::Point2f step(-coefficients.x() / coefficients.z(), -coefficients.y() / coefficients.z());
    const float sum = dot(seen, Grid(seen.size(), 1));
    const float variance = dot(seen, seen) - sum * sum / static_cast<float>(window_ * window_);
    return {guess + step, product / (norm_ * std::sqrt(variance)), false};
  }

 private:
  static Grid sampled(const cv::Mat& image, const cv::Point2f& corner, int size) {
    const int x = cvFloor(corner.x);
    const int y = cvFloor(corner.y);
    const float a = corner.x - static_cast<float>(x);
    const float b = corner.y - static_cast<float>(y);
    const auto weight = [](float share) { return static_cast<int>(std::lround(share * 16384.0F)); };
    const int right = weight(a * (1.0F - b));
    const int below = weight((1.0F - a) * b);
    const int both = weight(a * b);
    const int here = 16384 - right - below - both;
    Grid grid;
    for (int r = y; r < y + size; ++r) {
      for (int c = x; c < x + size; ++c) {
        const int sum = here * image.at<uchar>(r, c) + right * image.at<uchar>(r, c + 1) +
                        below * image.at<uchar>(r + 1, c) + both * image.at<uchar>(r + 1, c + 1);
        grid.push_back((sum + 1024) / 2048);
      }
    }
    return grid;
  }

  /// The remainder of the sum is subtracted from the first values, 1 from each.
  static void removeMean(Grid& grid) {
    const auto count = static_cast<int>(grid.size());
    const int sum = std::accumulate(grid.begin(), grid.end(), 0);
    const int mean = cvFloor(static_cast<double>(sum) / count);
    for (int i = 0; i < count; ++i)
      grid[static_cast<std::size_t>(i)] -= mean + (i < sum - mean * count ? 1 : 0);
    ASSERT_EQ(std::accumulate(grid.begin(), grid.end(), 0), 0);
  }

  static float dot(const Grid& a, const Grid& b) {
    const auto sum = std::inner_product(a.begin(), a.end(), b.begin(), std::int64_t{0});
    EXPECT_EQ(sum, static_cast<std::int32_t>(sum)) << "Patch has 32 bits";
    return static_cast<float>(sum);
  }

  int window_;
  std::array<Grid, 3> fields_;
  Eigen::Matrix3f inverse_moments_;
  float norm_ = 0.0F;
};

/// Noise between two grey levels; `smooth_px` 0 leaves neighbours independent.
cv::Mat noise(int darkest, int brightest, double smooth_px) {
  cv::Mat image(80, 80, CV_8UC1);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  if (smooth_px > 0.0) cv::GaussianBlur(image, image, {0, 0}, smooth_px);
  cv::normalize(image, image, darkest, brightest, cv::NORM_MINMAX);
  return image;
}

TEST(PatchTest, VectorInstructionsGiveWhatPlainArithmeticGives) {
  cv::Mat black_and_white;
  cv::threshold(noise(0, 255, 1.5), black_and_white, 100, 255, cv::THRESH_BINARY);
  // Faint patches reveal an error of a single unit; the strongest contrast comes close to the limit of 32
  // bits.
  for (const cv::Mat& image : {noise(100, 103, 1.5), noise(252, 255, 1.5), noise(0, 255, 1.5),
                               noise(0, 255, 0.7), black_and_white}) {
    const cv::Mat level = ImagePyramid(image, 1).level(0);
    for (int window = 5; window <= Patch::kMaxWindow; window += 2) {
      const cv::Point2f centre(39.3F, 41.8F);
      const cv::Point2f guess = centre + cv::Point2f(0.23F, -0.31F);
      const auto patch = Patch::cut(level, centre, window, 0.0);
      ASSERT_TRUE(patch) << window;
      const Patch::Match expected = PlainPatch(level, centre, window).step(level, guess);
      const auto match = patch->align(level, guess, 1, 1e-9);
      ASSERT_TRUE(match) << window;
      EXPECT_FLOAT_EQ(match->px.x, expected.px.x) << window;
      EXPECT_FLOAT_EQ(match->px.y, expected.px.y) << window;
      EXPECT_FLOAT_EQ(match->correlation, expected.correlation) << window;
    }
  }
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
}  // namespace stereo_nav::vision
