#include "sim/image_processing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

TEST(ImageProcessing, TheToneCurveLiftsShadowsAndClips) {
  ProcessingParams params;
  params.gamma = 2.0;
  const ImageProcessing processing(params);
  EXPECT_EQ(processing.tone(0.0f), 0.0f);
  EXPECT_NEAR(processing.tone(0.25f * 255.0f), 0.5 * 255.0, 0.01);
  EXPECT_NEAR(processing.tone(0.04f * 255.0f), 0.2 * 255.0, 0.05);
  EXPECT_EQ(processing.tone(255.0f), 255.0f);
  EXPECT_EQ(processing.tone(1000.0f), 255.0f);
  EXPECT_EQ(processing.tone(-3.0f), 0.0f);
  EXPECT_NEAR(processing.tone(0.51f), 255.0 * std::sqrt(0.004) / 2.0, 0.05);  // half of the toe
}

TEST(ImageProcessing, SharpeningPutsHalosOfKnownHeightBesideAnEdge) {
  ProcessingParams params;
  params.sharpening = 0.9;
  params.sharpening_px = 1.0;
  cv::Mat image(40, 60, CV_32FC1, cv::Scalar(80.0));
  image.colRange(30, 60).setTo(140.0);
  ImageProcessing(params).sharpen(image);
  const double overshoot = 0.9 * 60.0 * 0.5 * std::erfc(0.5 / std::sqrt(2.0));  // P(normal > 0.5)
  EXPECT_NEAR(image.at<float>(20, 30), 140.0 + overshoot, 0.5);
  EXPECT_NEAR(image.at<float>(20, 29), 80.0 - overshoot, 0.5);
  EXPECT_NEAR(image.at<float>(20, 40), 140.0, 1e-3);  // none far from the edge
}

TEST(ImageProcessing, ImagesOf640x480AreCompressedTo30To50kB) {
  const Simulation simulation(loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena_webcam.yaml"),
                              thesisRig(), 1);
  ProcessingParams params;
  params.jpeg_kb = 40.0;
  for (const std::size_t pair : {std::size_t{0}, std::size_t{300}, std::size_t{600}}) {
    const cv::Mat image = simulation.image(Side::kLeft, pair);
    ASSERT_EQ(image.size(), cv::Size(640, 480));
    const CompressedImage compressed = ImageProcessing(params).compress(image);
    EXPECT_GE(compressed.bytes.size(), 30000u) << pair;
    EXPECT_LE(compressed.bytes.size(), 50000u) << pair;
    EXPECT_LT(compressed.quality, 93);
    EXPECT_LT(cv::norm(cv::imdecode(compressed.bytes, cv::IMREAD_GRAYSCALE), image, cv::NORM_L1) /
                  static_cast<double>(image.total()),
              8.0);
  }
}

TEST(ImageProcessing, AnEmptyImageStaysSmall) {
  ProcessingParams params;
  params.jpeg_kb = 40.0;
  const CompressedImage compressed =
      ImageProcessing(params).compress(cv::Mat(480, 640, CV_8UC1, cv::Scalar(100)));
  EXPECT_LT(compressed.bytes.size(), 8000u);
  EXPECT_GT(compressed.quality, 85);
}

TEST(ImageProcessing, LinearAndUncompressedIsRounding) {
  const cv::Mat signal = (cv::Mat_<float>(1, 5) << -4.0f, 0.49f, 100.5f, 254.6f, 300.0f);
  const cv::Mat rounded = (cv::Mat_<uchar>(1, 5) << 0, 0, 101, 255, 255);
  const cv::Mat image = ImageProcessing(ProcessingParams()).develop(signal);
  EXPECT_EQ(cv::norm(image, rounded, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace stereo_nav::sim
