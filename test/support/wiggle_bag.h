#pragma once

#include <Eigen/Geometry>
#include <string>

namespace stereo_nav::test {

/// A rig that somebody turns to and fro in the simulated arena, its IMU mounted askew.
struct Wiggle {
  Eigen::Vector3d amplitude_deg{12.0, 15.0, 10.0};  ///< about the camera's x, y and z axis
  Eigen::Vector3d frequency_hz{0.40, 0.31, 0.53};
  double duration_s = 10.0;
  double rate_hz = 15.0;
  Eigen::Matrix3d R_camera_imu = Eigen::Matrix3d::Identity();  ///< IMU frame -> rectified left optical frame
  double imu_offset_s = 0.0;                                   ///< the IMU's stamps are late by it
  bool attitudes = false;  ///< a module that sends angles; otherwise rates with noise and bias
};

/// Writes raw stereo images (the thesis' cameras, 320x240, with noise), camera_info and imu/data, without
/// tf. Repeatable to the byte.
void writeWiggleBag(const std::string& path, const Wiggle& wiggle);

}  // namespace stereo_nav::test
