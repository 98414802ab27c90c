#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

namespace stereo_nav::sim {

/// One camera's calibration with the numbers of a camera_info (model plumb_bob: k1, k2, p1, p2, k3).
/// Pixels count from the centre of the upper left one.
struct CameraCalibration {
  std::string name;
  int width = 0;
  int height = 0;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  std::array<double, 5> D{};
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< raw optical -> rectified optical coordinates
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();

  /// Raw (distorted) pixel of a ray (x/z, y/z) in the raw optical frame.
  Eigen::Vector2d distort(const Eigen::Vector2d& ray) const;

  /// Ray (x/z, y/z) in the raw optical frame that is seen at a raw pixel; by Newton's method, exact to 1e-10.
  /// Throws std::runtime_error where the distortion polynomial cannot be inverted.
  Eigen::Vector2d undistort(const Eigen::Vector2d& pixel) const;

  /// Position of this camera's centre in the rectified left optical frame: along x, from P(0, 3).
  double offsetX_m() const { return -P(0, 3) / P(0, 0); }
};

/// Reads a calibration file as camera_calibration and camera_info_manager write it.
/// Throws std::runtime_error that names the file and what is missing.
CameraCalibration loadCameraCalibration(const std::string& path);

/// Calibrations of the two raw cameras, with their rectification.
struct StereoCalibrationPair {
  CameraCalibration left;
  CameraCalibration right;
};

/// Reads left.yaml and right.yaml of a folder.
StereoCalibrationPair loadStereoCalibration(const std::string& folder);

/// The same lens before a sensor with `factor` times the pixels in each direction.
CameraCalibration scaled(const CameraCalibration& calibration, double factor);

}  // namespace stereo_nav::sim
