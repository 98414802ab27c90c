#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "sim/camera.h"

namespace stereo_nav::sim {

/// How far the middle of the image moves, in pixels, when the camera turns from one attitude to another.
Eigen::Vector2d turnedBy(const CameraCalibration& calibration, const Eigen::Matrix3d& R_world_first,
                         const Eigen::Matrix3d& R_world_last);

/// The image as if it had moved by `step_px` evenly while it was collected. A few rays that are spread over
/// an exposure show an edge as often as there are rays when the camera turns fast; smeared by the motion from
/// one ray to the next they show the blur of an open shutter.
cv::Mat smeared(const cv::Mat& light, const Eigen::Vector2d& step_px);

}  // namespace stereo_nav::sim
