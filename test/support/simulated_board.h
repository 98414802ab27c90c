#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/camera.h"
#include "stereo_nav/calibration/checkerboard.h"

namespace stereo_nav::test {

/// The disturbances between the board and the pixels of a webcam.
struct WebcamFaults {
  double blur_px = 0.8;  ///< standard deviation of the lens' blur, at 640 px of width
  double read_noise = 2.0;
  double shot_noise = 0.12;
  double right_gain = 0.85;  ///< the right camera's images are darker
};

/// Draws a checkerboard as two webcams see it: raw, distorted images. Each pixel is the mean of 16 rays
/// through the lens model, blurred, with vignetting and noise (sim::ImageSensor).
class SimulatedBoard {
 public:
  SimulatedBoard(const sim::CameraCalibration& left, const sim::CameraCalibration& right,
                 const calibration::Checkerboard& board, const WebcamFaults& faults = {});

  struct Pair {
    cv::Mat left;   ///< CV_8UC1
    cv::Mat right;  ///< CV_8UC1
  };
  /// `T_camera_board` is in the rectified left optical frame; equal seeds give equal noise.
  Pair draw(const Eigen::Isometry3d& T_camera_board, std::uint64_t seed) const;

  /// Whether the inner corners and a square around them are in both images.
  bool inView(const Eigen::Isometry3d& T_camera_board) const;

  const sim::CameraCalibration& left() const { return left_.calibration; }
  const sim::CameraCalibration& right() const { return right_.calibration; }
  const calibration::Checkerboard& board() const { return board_; }

 private:
  struct Eye {
    sim::CameraCalibration calibration;
    std::vector<Eigen::Vector3d> rays;  ///< rectified optical frame, [row][column][ray]
  };
  static Eye makeEye(const sim::CameraCalibration& calibration);
  cv::Mat draw(const Eye& eye, const Eigen::Isometry3d& T_camera_board, double gain, std::uint64_t key) const;
  bool inView(const Eye& eye, const Eigen::Isometry3d& T_camera_board) const;

  Eye left_, right_;
  calibration::Checkerboard board_;
  WebcamFaults faults_;
};

/// A board whose middle is at (x, y, z) m in the rectified left optical frame and which is turned from
/// facing the camera by the angles of calibration::BoardAngles.
Eigen::Isometry3d boardAt(double x_m, double y_m, double z_m, double yaw_deg, double pitch_deg,
                          double roll_deg);

}  // namespace stereo_nav::test
