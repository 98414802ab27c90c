#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::test {

/// A room of textured planes, 4 m wide and high enough to see floor and ceiling, its back wall 6 m ahead of
/// the origin: every pixel has a known point. Axes as of an optical frame (x right, y down, z forward).
class TexturedRoom {
 public:
  /// Distance along a ray from `origin` (m, inside the room) to the wall it hits, in lengths of `direction`.
  double distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Grey level, 0 to 255, of a point on a wall: value noise of several octaves, the same in every run.
  double greyLevel(const Eigen::Vector3d& p_room) const;

  /// What a pinhole camera sees, CV_8UC1, each pixel the mean of 2 x 2 rays.
  cv::Mat render(const Eigen::Isometry3d& T_room_camera, double fx, double fy, double cx, double cy,
                 cv::Size size) const;

  struct Pair {
    cv::Mat left;
    cv::Mat right;
  };
  /// A rectified pair, left camera at `T_room_left`, right camera at its own pose's baseline.
  Pair renderPair(const Eigen::Isometry3d& T_room_left, const Eigen::Isometry3d& T_room_left_at_right_time,
                  const vision::StereoCalibration& calibration) const;

  /// Exact disparity of the left image, CV_32FC1, px.
  cv::Mat disparity(const Eigen::Isometry3d& T_room_left, const vision::StereoCalibration& calibration) const;
};

/// 320 x 240, 60 degrees of view, 0.12 m baseline: the thesis' rig, rectified.
vision::StereoCalibration roomCalibration();

/// Poses of the left camera in the room, one each `period_s`: drives forward at 0.4 m/s and turns by 10
/// degrees/s.
Eigen::Isometry3d roomDrive(double time_s);

}  // namespace stereo_nav::test
