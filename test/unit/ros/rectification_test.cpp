// evaluate, the image nodelets, check_calibration and the simulator rectify every kind of calibration alike.
#include <gtest/gtest.h>
#include <image_geometry/pinhole_camera_model.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "ros/judged_infos.h"
#include "ros/stereo_processing.h"
#include "sim/camera.h"
#include "stereo_nav/calibration/stereo_rig.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

using sensor_msgs::CameraInfo;

struct InfoPair {
  CameraInfo left, right;
};

CameraInfo bentInfo(bool right) {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {-0.2, 0.05, 0.001, -0.002, 0.0};
  info.K = {500, 0, 322, 0, 502, 238, 0, 0, 1};
  const double angle = right ? 0.01 : -0.005, c = std::cos(angle), s = std::sin(angle);
  info.R = {c, 0, s, 0, 1, 0, -s, 0, c};
  info.P = {470, 0, 315, right ? -470 * 0.12 : 0.0, 0, 470, 235, 0, 0, 0, 1, 0};
  return info;
}

InfoPair infosWith(const std::function<void(CameraInfo&, bool)>& change) {
  InfoPair pair{bentInfo(false), bentInfo(true)};
  change(pair.left, false);
  change(pair.right, true);
  return pair;
}

/// Pixels whose values are their own column or row; between pixels they are exact, too.
cv::Mat ramp(const cv::Size& size, bool columns) {
  cv::Mat image(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) image.at<float>(y, x) = static_cast<float>(columns ? x : y);
  }
  return image;
}

/// What image_proc/rectify does with an image and the camera_info it is handed.
cv::Mat asTheNodelet(const CameraInfo& info, const cv::Mat& raw) {
  if (std::all_of(info.D.begin(), info.D.end(), [](double value) { return value == 0.0; })) return raw;
  image_geometry::PinholeCameraModel model;
  model.fromCameraInfo(info);
  cv::Mat rectified;
  model.rectifyImage(raw, rectified, cv::INTER_LINEAR);
  return rectified;
}

float valueAt(const cv::Mat& image, const Eigen::Vector2d& px) {
  cv::Mat value;
  cv::getRectSubPix(image, cv::Size(1, 1),
                    cv::Point2f(static_cast<float>(px.x()), static_cast<float>(px.y())), value);
  return value.at<float>(0, 0);
}

/// As check_calibration makes it.
calibration::CameraModel modelOf(const CameraInfo& info) {
  calibration::CameraModel model;
  model.size = cv::Size(static_cast<int>(info.width), static_cast<int>(info.height));
  model.K = cv::Matx33d(info.K.data());
  model.R = cv::Matx33d(info.R.data());
  model.P = cv::Matx34d(info.P.data());
  model.D = cv::Mat(info.D, true).reshape(1, 1);
  return model;
}

/// Raw pixel of a rectified one by the simulator's lens.
Eigen::Vector2d simulated(const CameraInfo& info, const Eigen::Vector2d& rectified) {
  sim::CameraCalibration camera;
  using RowMajor33 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  camera.K = Eigen::Map<const RowMajor33>(info.K.data());
  std::copy(info.D.begin(), info.D.end(), camera.D.begin());
  const Eigen::Vector3d ray((rectified.x() - info.P[2]) / info.P[0], (rectified.y() - info.P[6]) / info.P[5],
                            1.0);
  return camera.distort((Eigen::Map<const RowMajor33>(info.R.data()).transpose() * ray).hnormalized());
}

void expectAlike(const InfoPair& pair, const cv::Size& delivered) {
  const StereoProcessing evaluate(pair.left, pair.right, {});
  const JudgedInfos judged = judgeInfos(pair.left, pair.right);
  for (const bool right : {false, true}) {
    const CameraInfo& info = right ? judged.right : judged.left;
    ASSERT_EQ(cv::Size(static_cast<int>(info.width), static_cast<int>(info.height)), delivered);
    std::array<cv::Mat, 2> rectified;
    for (const bool columns : {true, false}) {
      const cv::Mat raw = ramp(delivered, columns);
      cv::Mat& image = rectified[columns ? 0 : 1];
      image = right ? evaluate.rectifyRight(raw) : evaluate.rectifyLeft(raw);
      EXPECT_EQ(cv::norm(image, asTheNodelet(info, raw), cv::NORM_INF), 0.0) << "evaluate and the nodelet";
    }
    const cv::Mat rows = rawRows(info);
    const calibration::CameraModel model = modelOf(info);
    double most_moved_px = 0.0;
    for (double x = 0.2; x < 0.9; x += 0.2) {
      for (double y = 0.2; y < 0.9; y += 0.2) {
        const cv::Point2f raw(static_cast<float>(x * delivered.width),
                              static_cast<float>(y * delivered.height));
        const Eigen::Vector2d px = model.rectify({raw}).front();
        most_moved_px = std::max(most_moved_px, std::hypot(px.x() - raw.x, px.y() - raw.y));
        constexpr double kMapStep_px = 0.04;  // OpenCV's maps count in 1/32
        EXPECT_NEAR(valueAt(rectified[0], px), raw.x, kMapStep_px) << "evaluate and check_calibration";
        EXPECT_NEAR(valueAt(rectified[1], px), raw.y, kMapStep_px);
        EXPECT_NEAR(valueAt(rows, px), raw.y, kMapStep_px) << "the rows of a rolling shutter";
        if (info.D.size() != 5) continue;
        EXPECT_LT((simulated(info, px) - Eigen::Vector2d(raw.x, raw.y)).norm(), 0.01) << "the simulator";
      }
    }
    EXPECT_GT(most_moved_px, 1.0) << "a rectification that does something";
  }
}

TEST(Rectification, IsTheSameInAllPrograms) {
  const cv::Size whole(640, 480);
  expectAlike(infosWith([](CameraInfo&, bool) {}), whole);
  // No distortion: image_proc would copy the images.
  expectAlike(infosWith([](CameraInfo& info, bool) { info.D.assign(5, 0.0); }), whole);
  expectAlike(infosWith([](CameraInfo& info, bool) {
                info.D.assign(5, 0.0);
                info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
              }),
              whole);
  expectAlike(infosWith([](CameraInfo& info, bool) {
                info.distortion_model = "rational_polynomial";
                info.D = {0.1, 0.02, 0.001, -0.001, 0.01, 0.3, 0.05, 0.02};
              }),
              whole);
  expectAlike(infosWith([](CameraInfo& info, bool) {
                info.roi.x_offset = 100;
                info.roi.y_offset = 60;
                info.roi.width = 400;
                info.roi.height = 300;
              }),
              cv::Size(400, 300));
  expectAlike(infosWith([](CameraInfo& info, bool) { info.binning_x = info.binning_y = 2; }),
              cv::Size(320, 240));
  expectAlike(infosWith([](CameraInfo& info, bool right) {
                info.K[2] = right ? 360 : 270;
                info.P[2] = right ? 350 : 280;
              }),
              whole);
  expectAlike(infosWith([](CameraInfo& info, bool right) { info.K[0] = info.K[4] = right ? 540 : 490; }),
              whole);
}

}  // namespace
}  // namespace stereo_nav::ros_io
