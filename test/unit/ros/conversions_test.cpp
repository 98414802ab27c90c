#include "stereo_nav/ros/conversions.h"

#include <gtest/gtest.h>
#include <image_geometry/pinhole_camera_model.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

#include "stereo_nav/core/input_error.h"
#include "support/text.h"

namespace stereo_nav::ros_io {
namespace {

sensor_msgs::CameraInfo info(bool right) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera_left_optical";
  info.width = 320;
  info.height = 240;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {417, 0, 154, 0, 417, 131, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {463.776846, 0, 141.829867, right ? -56.859879 : 0.0, 0, 463.776846, 117.138942, 0, 0, 0, 1, 0};
  return info;
}

std::string refusal(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right) {
  try {
    toCalibration(left, right);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ToCalibration, ReadsTheThesisRig) {
  const auto calibration = toCalibration(info(false), info(true));
  EXPECT_NEAR(calibration.baseline_m, 0.1226, 1e-4);
  EXPECT_DOUBLE_EQ(calibration.fx, 463.776846);
  EXPECT_DOUBLE_EQ(calibration.cy, 117.138942);
  EXPECT_EQ(calibration.width, 320);
}

TEST(ToCalibration, RefusesWhatImageGeometryWouldAbortOnOrMisread) {
  auto right = info(true);
  right.header.frame_id = "camera_right_optical";
  EXPECT_TRUE(contains(refusal(info(false), right), "frame ids differ"));
  right = info(true);
  right.P[3] = 0.0;
  EXPECT_TRUE(contains(refusal(info(false), right), "without baseline"));
  EXPECT_TRUE(contains(refusal(info(true), info(false)), "swapped"));
  right = info(true);
  right.P[3] = 56.86;
  EXPECT_TRUE(contains(refusal(info(false), right), "swapped"));
  right = info(true);
  right.width = 640;
  EXPECT_TRUE(contains(refusal(info(false), right), "320x240"));
  right = info(true);
  right.K[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(refusal(info(false), right), "NaN"));
  EXPECT_TRUE(contains(refusal(sensor_msgs::CameraInfo(), sensor_msgs::CameraInfo()), "not calibrated"));
}

/// The rows agree with image_geometry, by which image_proc rectifies.
TEST(RawRows, AreThoseOfTheUnrectifiedPixels) {
  sensor_msgs::CameraInfo camera = info(false);
  camera.D = {-0.3, 0.1, 0.001, -0.002, 0.0};
  const double tilt = 0.03;
  camera.R = {1, 0, 0, 0, std::cos(tilt), -std::sin(tilt), 0, std::sin(tilt), std::cos(tilt)};
  const cv::Mat rows = rawRows(camera);
  ASSERT_EQ(rows.size(), cv::Size(320, 240));
  image_geometry::PinholeCameraModel model;
  model.fromCameraInfo(camera);
  for (const cv::Point px : {cv::Point(10, 10), cv::Point(160, 120), cv::Point(310, 200)}) {
    const double row = model.unrectifyPoint(cv::Point2d(px)).y;
    EXPECT_NEAR(rows.at<float>(px), row, 0.01);
    EXPECT_GT(std::abs(row - px.y), 1.0) << "a rectification that does something";
  }
}

sensor_msgs::ImagePtr image(const std::string& encoding, unsigned bytes_per_pixel, unsigned char value) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->encoding = encoding;
  message->width = 4;
  message->height = 2;
  message->step = 4 * bytes_per_pixel;
  message->data.assign(message->step * 2, value);
  return message;
}

TEST(ToMono8, TakesGreyColourAnd16Bit) {
  EXPECT_EQ(toMono8(image("mono8", 1, 77)).at<unsigned char>(1, 3), 77);
  EXPECT_EQ(toMono8(image("bgr8", 3, 77)).at<unsigned char>(1, 3), 77);
  EXPECT_EQ(toMono8(image("rgba8", 4, 77)).at<unsigned char>(1, 3), 77);
  // 0x4D4D of 0xFFFF is 77 of 255.
  EXPECT_EQ(toMono8(image("mono16", 2, 77)).at<unsigned char>(1, 3), 77);
}

TEST(ToMono8, ColourWeighsAsGrey) {
  const auto message = image("rgb8", 3, 0);
  for (std::size_t i = 0; i < message->data.size(); i += 3) message->data[i] = 200;  // pure red
  EXPECT_EQ(toMono8(message).at<unsigned char>(0, 0), 60);                           // 0.299 * 200
}

TEST(ToMono8, RefusesOtherEncodingsAndDamagedData) {
  EXPECT_THROW(toMono8(image("32FC1", 4, 0)), InputError);
  EXPECT_THROW(toMono8(image("16UC1", 2, 0)), InputError);
  const auto short_data = image("mono8", 1, 0);
  short_data->data.pop_back();
  EXPECT_THROW(toMono8(short_data), InputError);
  const auto short_step = image("bgr8", 3, 0);
  short_step->step = 4;
  EXPECT_THROW(toMono8(short_step), InputError);
}

stereo_msgs::DisparityImage disparityImage(const std::vector<float>& values, float min_disparity) {
  stereo_msgs::DisparityImage message;
  message.min_disparity = min_disparity;
  message.image.encoding = "32FC1";
  message.image.width = static_cast<unsigned>(values.size());
  message.image.height = 1;
  message.image.step = static_cast<unsigned>(values.size() * sizeof(float));
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  message.image.data.assign(bytes, bytes + values.size() * sizeof(float));
  return message;
}

TEST(ToDisparityMap, TheMarkerIsUnknownEvenWhereItIsPositive) {
  vision::StereoCalibration calibration = toCalibration(info(false), info(true));
  calibration.width = 3;
  calibration.height = 1;
  // Block matching marks unknown pixels with min_disparity - 1.
  const cv::Mat map = toDisparityMap(disparityImage({9.0F, 10.0F, 30.5F}, 10.0F), calibration);
  EXPECT_EQ(map.at<float>(0, 0), -1.0F);
  EXPECT_EQ(map.at<float>(0, 1), 10.0F);
  EXPECT_EQ(map.at<float>(0, 2), 30.5F);
}

TEST(ToDisparityMap, TheMarkerMovesWithThePrincipalPoints) {
  vision::StereoCalibration calibration = toCalibration(info(false), info(true));
  calibration.width = 2;
  calibration.height = 1;
  calibration.right_cx = calibration.cx - 5.0;  // the nodelet has taken 5 px off every value, markers too
  const cv::Mat map = toDisparityMap(disparityImage({-6.0F, -4.0F}, 0.0F), calibration);
  EXPECT_EQ(map.at<float>(0, 0), -1.0F);
  EXPECT_EQ(map.at<float>(0, 1), -4.0F);
}

TEST(ToImuSample, MinusOneMeansAbsent) {
  sensor_msgs::Imu imu;
  imu.header.stamp = ros::Time(12.5);
  imu.orientation.w = 1.0;
  imu.orientation_covariance[0] = -1.0;
  imu.angular_velocity.z = 0.3;
  imu.linear_acceleration_covariance[0] = -1.0;
  const auto sample = toImuSample(imu);
  EXPECT_EQ(sample.time_s, 12.5);
  EXPECT_FALSE(sample.q_world_imu);
  EXPECT_FALSE(sample.linear_acceleration);
  ASSERT_TRUE(sample.angular_velocity);
  EXPECT_EQ(sample.angular_velocity->z(), 0.3);
}

TEST(ToImuSample, AnOrientationThatWasNeverFilledIsAbsent) {
  EXPECT_FALSE(toImuSample(sensor_msgs::Imu()).q_world_imu);
}

}  // namespace
}  // namespace stereo_nav::ros_io
