#pragma once

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace stereo_nav::test {

/// Two pinhole cameras side by side that look at a checkerboard of 8x6 inner corners.
struct CheckerboardRig {
  int width = 320, height = 240;
  double focal_length_px = 417.0;
  double baseline_m = 0.12;
  double square_m = 0.051;

  /// The board in a pose that wanders through the whole view, as the camera at `camera_x_m` sees it.
  cv::Mat draw(double time_s, double camera_x_m) const {
    const cv::Matx33d K(focal_length_px, 0, 0.5 * width, 0, focal_length_px, 0.5 * height, 0, 0, 1);
    const cv::Vec3d rotation(0.5 * std::sin(0.7 * time_s), 0.5 * std::cos(0.5 * time_s),
                             0.1 * std::sin(0.3 * time_s));
    const cv::Vec3d translation(0.15 * std::sin(0.4 * time_s) - camera_x_m, 0.12 * std::sin(0.55 * time_s),
                                1.0 + 0.25 * std::sin(0.23 * time_s));
    constexpr int kSquaresX = 9, kSquaresY = 7;
    cv::Mat image(height, width, CV_8UC1, cv::Scalar(190));
    for (int y = 0; y < kSquaresY; ++y) {
      for (int x = y % 2; x < kSquaresX; x += 2) {
        std::vector<cv::Point3d> corners;
        for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
          corners.emplace_back((x + dx - 0.5 * kSquaresX) * square_m, (y + dy - 0.5 * kSquaresY) * square_m,
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
};

}  // namespace stereo_nav::test
