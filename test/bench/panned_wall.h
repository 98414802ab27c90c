#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::bench {

/// Noise of several octaves, wide enough to pan over it; the same in every run.
inline cv::Mat makeTexture(const cv::Size& size) {
  cv::RNG random(7);
  cv::Mat sum(size, CV_32FC1, cv::Scalar(0));
  for (const int octave : {2, 4, 8, 16}) {
    cv::Mat noise(size.height / octave + 1, size.width / octave + 1, CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 0.0, 30.0);
    cv::resize(noise, noise, size, 0, 0, cv::INTER_CUBIC);
    sum += noise;
  }
  cv::Mat image;
  sum.convertTo(image, CV_8UC1, 0.7, 128.0);
  return image;
}

inline vision::StereoCalibration wallCamera(const cv::Size& size) {
  vision::StereoCalibration calibration;
  calibration.width = size.width;
  calibration.height = size.height;
  calibration.fx = calibration.fy = 0.6 * size.width;
  calibration.cx = calibration.right_cx = 0.5 * size.width;
  calibration.cy = 0.5 * size.height;
  calibration.baseline_m = 0.12;
  return calibration;
}

/// A wall that is passed sideways, back and forth, at 20 Hz: nothing to download, and every image size alike.
class PannedWall {
 public:
  explicit PannedWall(const vision::StereoCalibration& calibration)
      : size_(calibration.width, calibration.height),
        texture_(makeTexture({calibration.width + 400, calibration.height})) {}

  odometry::StereoFrame next() {
    constexpr int kSteps = 40;
    constexpr int kDisparity_px = 12;
    const int step = frame_ % (2 * kSteps);
    const int x = 3 * (step < kSteps ? step : 2 * kSteps - step);
    odometry::StereoFrame frame;
    frame.left_time_s = frame.right_time_s = 0.05 * frame_++;
    frame.left = texture_(cv::Rect(x, 0, size_.width, size_.height)).clone();
    frame.right = texture_(cv::Rect(x + kDisparity_px, 0, size_.width, size_.height)).clone();
    return frame;
  }

 private:
  cv::Size size_;
  cv::Mat texture_;
  int frame_ = 0;
};

}  // namespace stereo_nav::bench
