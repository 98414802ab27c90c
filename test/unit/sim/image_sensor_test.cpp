#include "sim/image_sensor.h"

#include <gtest/gtest.h>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

const cv::Mat kGrey(240, 320, CV_32FC1, cv::Scalar(100.0));

TEST(ImageSensor, NoiseHasItsSpreadAndNoMean) {
  const SensorParams params = sensorWith(3.0, 0.2, 0.0);
  const cv::Mat image = ImageSensor(320, 240, params, CameraResponse()).expose(kGrey, 42);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  EXPECT_NEAR(mean[0], 100.0, 0.1);
  EXPECT_NEAR(deviation[0], std::sqrt(9.0 + 0.04 * 100.0 + 1.0 / 12.0), 0.1);
}

TEST(ImageSensor, GainOffsetVignettingAndSaturation) {
  const SensorParams params = sensorWith(0.0, 0.0, 0.5);
  CameraResponse response;
  response.gain = 1.2;
  response.offset = -20.0;
  const cv::Mat image =
      ImageSensor(321, 241, params, response).expose(cv::Mat(241, 321, CV_32FC1, cv::Scalar(100.0)), 1);
  EXPECT_EQ(image.at<uchar>(120, 160), 100);  // 1.2 * 100 - 20
  EXPECT_EQ(image.at<uchar>(0, 0), 40);       // 1.2 * 50 - 20
  const cv::Mat bright(240, 320, CV_32FC1, cv::Scalar(1000.0));
  EXPECT_EQ(ImageSensor(320, 240, params, response).expose(bright, 1).at<uchar>(120, 160), 255);
}

TEST(ImageSensor, NoiseDependsOnTheKeyAlone) {
  const ImageSensor sensor(320, 240, SensorParams(), CameraResponse());
  EXPECT_EQ(cv::norm(sensor.expose(kGrey, 1), sensor.expose(kGrey, 1), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(sensor.expose(kGrey, 1), sensor.expose(kGrey, 2), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace stereo_nav::sim
