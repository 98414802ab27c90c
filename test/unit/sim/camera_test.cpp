#include <gtest/gtest.h>

#include <fstream>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

TEST(CameraCalibration, DistortionAgreesWithOpenCv) {
  const CameraCalibration camera = thesisRig().left;
  cv::Mat K = cv::Mat::eye(3, 3, CV_64F);
  K.at<double>(0, 0) = camera.K(0, 0), K.at<double>(1, 1) = camera.K(1, 1);
  K.at<double>(0, 2) = camera.K(0, 2), K.at<double>(1, 2) = camera.K(1, 2);
  const cv::Mat D(1, 5, CV_64F, const_cast<double*>(camera.D.data()));
  for (const cv::Point3d& point :
       {cv::Point3d(0.3, -0.2, 1.0), cv::Point3d(-0.35, 0.25, 1.0), cv::Point3d(0, 0, 1)}) {
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{point}, cv::Vec3d(), cv::Vec3d(), K, D, expected);
    const Eigen::Vector2d pixel = camera.distort({point.x, point.y});
    EXPECT_NEAR(pixel.x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel.y(), expected[0].y, 1e-9);
  }
}

TEST(CameraCalibration, UndistortionInvertsDistortionUpToTheCorners) {
  for (const int factor : {1, 2, 4}) {
    const CameraCalibration camera = scaled(thesisRig().right, factor);
    for (const double x : {-0.5, camera.width / 3.0, camera.width - 0.5}) {
      for (const double y : {-0.5, camera.height / 2.0, camera.height - 0.5}) {
        EXPECT_LT((camera.distort(camera.undistort({x, y})) - Eigen::Vector2d(x, y)).norm(), 1e-8);
      }
    }
  }
}

TEST(CameraCalibration, ScalingKeepsRaysAndBaseline) {
  const CameraCalibration small = thesisRig().right, large = scaled(small, 2);
  EXPECT_EQ(large.width, 640);
  // The border between the pixels 9 and 10 of the small image is that between 19 and 20 of the large one.
  EXPECT_LT((small.undistort({9.5, 9.5}) - large.undistort({19.5, 19.5})).norm(), 1e-9);
  EXPECT_NEAR(small.offsetX_m(), 56.859879 / 463.776846, 1e-12);
  EXPECT_NEAR(large.offsetX_m(), small.offsetX_m(), 1e-12);
}

TEST(CameraCalibration, ADamagedFileIsNamed) {
  const std::string path = testing::TempDir() + "broken.yaml";
  std::ofstream(path) << "image_width: 320\ndistortion_model: plumb_bob\n";
  try {
    loadCameraCalibration(path);
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("broken.yaml: not a usable camera calibration"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace stereo_nav::sim
