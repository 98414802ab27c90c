#include "ros/stereo_processing.h"

#include <gtest/gtest.h>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"
#include "support/fixture_bag.h"
#include "support/textured_room.h"

namespace stereo_nav::ros_io {
namespace {

TEST(StereoProcessing, DisparityOfAKnownSceneIsTheAnalyticOne) {
  const auto calibration = test::roomCalibration();
  const test::TexturedRoom room;
  const Eigen::Isometry3d T_room_left = Eigen::Isometry3d::Identity();
  const auto pair = room.renderPair(T_room_left, T_room_left, calibration);
  const StereoProcessing processing(test::cameraInfo(calibration, false), test::cameraInfo(calibration, true),
                                    {});
  const cv::Mat measured =
      processing.disparity(processing.rectifyLeft(pair.left), processing.rectifyRight(pair.right));
  const cv::Mat exact = room.disparity(T_room_left, calibration);

  cv::Mat difference;
  cv::absdiff(measured, exact, difference);
  const int known = cv::countNonZero(measured > 0);
  const int close = cv::countNonZero((measured > 0) & (difference < 1.0));
  EXPECT_GT(known, measured.rows * measured.cols / 4);
  EXPECT_GT(close, known * 9 / 10);
}

TEST(StereoProcessing, RefusesImagesOfAnotherSizeThanTheirCalibration) {
  const auto calibration = test::roomCalibration();
  const StereoProcessing processing(test::cameraInfo(calibration, false), test::cameraInfo(calibration, true),
                                    {});
  EXPECT_THROW(processing.rectifyLeft(cv::Mat(480, 640, CV_8UC1)), InputError);
}

TEST(DisparityParams, TheShippedFileIsValidAndHoldsTheNodeletsDefaults) {
  DisparityParams params;
  params.disparity_range = 128;
  const std::string file = std::string(STEREO_NAV_SOURCE_DIR) + "/config/disparity.yaml";
  readParameters(loadYamlFile(file), file, params);
  EXPECT_EQ(params.disparity_range, 64);
}

}  // namespace
}  // namespace stereo_nav::ros_io
