#include "vision/rolling_shutter.h"

#include <gtest/gtest.h>

#include <vector>

namespace stereo_nav::vision {
namespace {

constexpr double kReadout_s = 0.03;

StereoCalibration calibrated() {
  StereoCalibration calibration;
  calibration.fx = calibration.fy = 417.0;
  calibration.cx = calibration.right_cx = 160.0;
  calibration.cy = 120.0;
  calibration.baseline_m = 0.1226;
  calibration.width = 320;
  calibration.height = 240;
  return calibration;
}

/// A rig that drives and turns, and points near and far all over its view.
class RollingShutterTest : public testing::Test {
 protected:
  RollingShutterTest() {
    twist << 0.05, -0.02, -0.5, 0.1, 1.0, -0.2;
    shutter.setReadout(kReadout_s);
    T_late_camera = expMotion(twist * 0.012);
    for (const double z : {0.8, 2.0, 30.0}) {
      for (const double x : {-0.3, 0.0, 0.35}) {
        for (const double y : {-0.25, 0.05, 0.25}) points.emplace_back(x * z, y * z, z);
      }
    }
  }

  /// The pixel whose row is read when the point is seen there: found by iteration, for any projection.
  template <typename Project, typename Time>
  Eigen::Vector2d seen(const Eigen::Vector3d& p, const Project& project, const Time& time_s) const {
    Eigen::Vector2d px = project(p);
    for (int i = 0; i < 20; ++i) px = project(expMotion(twist * time_s(px)) * p);
    return px;
  }
  Eigen::Vector2d seenLeft(const Eigen::Vector3d& p_camera) const {
    return seen(
        p_camera, [&](const Eigen::Vector3d& p) { return projectLeft(calibration, p); },
        [&](const Eigen::Vector2d& px) { return kReadout_s * ((px.y() + 0.5) / 240.0 - 0.5); });
  }
  Eigen::Vector2d seenRight(const Eigen::Vector3d& p_late) const {
    return seen(
        p_late, [&](const Eigen::Vector3d& p) { return projectRight(calibration, p); },
        [&](const Eigen::Vector2d& px) { return kReadout_s * ((px.y() + 0.5) / 240.0 - 0.5); });
  }

  StereoCalibration calibration = calibrated();
  RollingShutter shutter{calibration};
  Vector6d twist;
  Eigen::Isometry3d T_late_camera;
  std::vector<Eigen::Vector3d> points;
};

TEST_F(RollingShutterTest, BringsBothImagesToTheirStamps) {
  double largest_px = 0.0;
  for (const Eigen::Vector3d& p : points) {
    StereoObservation in_image;
    in_image.left_px = seenLeft(p);
    in_image.right_px = seenRight(T_late_camera * p);
    in_image.has_right = true;
    const StereoObservation straight = shutter.atStamp(in_image, p, T_late_camera, twist);
    EXPECT_LT((straight.left_px - projectLeft(calibration, p)).norm(), 0.01) << p.transpose();
    EXPECT_LT((straight.right_px - projectRight(calibration, T_late_camera * p)).norm(), 0.01)
        << p.transpose();
    largest_px = std::max(largest_px, (straight.left_px - in_image.left_px).norm());
  }
  EXPECT_GT(largest_px, 5.0) << "there was something to correct";
}

TEST_F(RollingShutterTest, PredictsWhereTheImageShowsAPoint) {
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d px = projectLeft(calibration, p);
    // The row of the prediction is that of the stamp: wrong by the motion within the shift, a few rows.
    EXPECT_LT((shutter.seenLeft(px, p, twist) - seenLeft(p)).norm(), 0.5) << p.transpose();
  }
}

TEST_F(RollingShutterTest, PlacesANewPointWhereItWasAtTheStamp) {
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d px = seenLeft(p);
    const double row_depth_m = (expMotion(twist * shutter.leftTime_s(px)) * p).z();
    const Eigen::Vector3d ray_depth = shutter.rayDepthAtStamp(px, 1.0 / row_depth_m, twist);
    EXPECT_NEAR(ray_depth.x(), p.x() / p.z(), 2e-5);
    EXPECT_NEAR(ray_depth.y(), p.y() / p.z(), 2e-5);
    EXPECT_NEAR(ray_depth.z() * p.z(), 1.0, 1e-4);
  }
}

TEST_F(RollingShutterTest, CountsTheRowsOfTheRawImages) {
  StereoCalibration rectified = calibration;
  rectified.left_raw_rows = cv::Mat(240, 320, CV_32FC1, cv::Scalar(0.0));
  rectified.right_raw_rows = cv::Mat(240, 320, CV_32FC1, cv::Scalar(239.0));
  RollingShutter raw(rectified);
  raw.setReadout(kReadout_s);
  const Eigen::Vector2d middle(160.0, 119.5);
  EXPECT_NEAR(raw.leftTime_s(middle), -0.5 * kReadout_s, 1e-4);
  EXPECT_NEAR(raw.rightTime_s(middle), 0.5 * kReadout_s, 1e-4);
  EXPECT_NEAR(raw.rightTime_s({-3.0, 500.0}), 0.5 * kReadout_s, 1e-4) << "beyond the image";
  EXPECT_NEAR(shutter.leftTime_s(middle), 0.0, 1e-9);
}

TEST_F(RollingShutterTest, LeavesTheImagesOfAGlobalShutterAlone) {
  shutter.setReadout(0.0);
  StereoObservation in_image;
  in_image.left_px = {10.0, 20.0};
  in_image.right_px = {5.0, 20.0};
  in_image.has_right = true;
  const StereoObservation straight = shutter.atStamp(in_image, points.front(), T_late_camera, twist);
  EXPECT_EQ(straight.left_px, in_image.left_px);
  EXPECT_EQ(straight.right_px, in_image.right_px);
  EXPECT_EQ(shutter.seenLeft(in_image.left_px, points.front(), twist), in_image.left_px);
}

}  // namespace
}  // namespace stereo_nav::vision
