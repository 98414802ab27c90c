// Shows a moving 8x6 checkerboard (inner corners) to the loopback cameras of vm.sh until it is ended: for
// trying camera_calibration by hand, see docs/results_capture.md.
#include <chrono>
#include <cmath>
#include <iostream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "v4l2/feeder.h"

namespace {

using namespace stereo_nav::capture;  // NOLINT: a program of one file

constexpr int kWidth = 320, kHeight = 240;
constexpr int kSquaresX = 9, kSquaresY = 7;
constexpr double kSquare_m = 0.051;
constexpr double kBaseline_m = 0.12;

/// The board in a pose that wanders through the view, as a camera at `camera_x_m` sees it.
cv::Mat drawBoard(double time_s, double camera_x_m) {
  const cv::Matx33d K(417, 0, 160, 0, 417, 120, 0, 0, 1);
  const cv::Vec3d rotation(0.3 * std::sin(0.7 * time_s), 0.3 * std::cos(0.5 * time_s),
                           0.1 * std::sin(0.3 * time_s));
  const cv::Vec3d translation(0.15 * std::sin(0.4 * time_s) - camera_x_m, 0.08 * std::sin(0.55 * time_s),
                              1.0 + 0.25 * std::sin(0.23 * time_s));
  cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(190));
  for (int y = 0; y < kSquaresY; ++y) {
    for (int x = 0; x < kSquaresX; ++x) {
      if ((x + y) % 2 != 0) continue;
      std::vector<cv::Point3d> corners;
      for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        corners.emplace_back((x + dx - 0.5 * kSquaresX) * kSquare_m, (y + dy - 0.5 * kSquaresY) * kSquare_m,
                             0.0);
      }
      std::vector<cv::Point2d> projected;
      cv::projectPoints(corners, rotation, translation, K, cv::noArray(), projected);
      constexpr int kShift = 4;  // sub-pixel bits
      std::vector<cv::Point> polygon;
      for (const auto& point : projected) polygon.emplace_back(point * (1 << kShift));
      cv::fillConvexPoly(image, polygon, cv::Scalar(30), cv::LINE_AA, kShift);
    }
  }
  return image;
}

}  // namespace

int main() {
  constexpr auto kPeriod = std::chrono::milliseconds(500);
  const auto first = std::chrono::steady_clock::now();
  const auto source = [](double camera_x_m) {
    return [camera_x_m](std::uint32_t counter) { return jpegOf(drawBoard(0.5 * counter, camera_x_m)); };
  };
  Feeder left("/dev/video10", V4L2_PIX_FMT_MJPEG, kWidth, kHeight);
  Feeder right("/dev/video11", V4L2_PIX_FMT_MJPEG, kWidth, kHeight);
  left.start(first, kPeriod, source(0.0));
  right.start(first, kPeriod, source(kBaseline_m));
  std::cout << "feeding\n" << std::flush;
  std::this_thread::sleep_for(std::chrono::hours(1));
}
