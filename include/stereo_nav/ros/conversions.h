#pragma once

#include <geometry_msgs/Transform.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <stereo_msgs/DisparityImage.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::ros_io {

/// Geometry of the rectified pair from both camera_infos. Throws InputError for everything image_geometry
/// would abort the process on or silently accept: differing frame ids or sizes, no stereo calibration (P[3] =
/// 0), swapped cameras (baseline negative), NaN, an uncalibrated camera (K all zero).
vision::StereoCalibration toCalibration(const sensor_msgs::CameraInfo& left,
                                        const sensor_msgs::CameraInfo& right);

/// Row of the raw image that each pixel of the rectified one comes from, CV_32FC1; empty for distortion
/// models that image_proc does not rectify with.
cv::Mat rawRows(const sensor_msgs::CameraInfo& info);

/// CV_8UC1 image. Takes mono8, mono16 (full range scaled to 8 bit), rgb8, bgr8, rgba8, bgra8, the 8-bit Bayer
/// patterns and yuv422; throws InputError that names any other encoding, and for data that is shorter than
/// width, height and step say. mono8 is shared with the message, not copied.
cv::Mat toMono8(const sensor_msgs::ImageConstPtr& image);

/// Disparity in px, CV_32FC1, with everything that the map marks as unknown set to -1 (the marker is one less
/// than the smallest disparity searched, which may itself be positive). Throws InputError for another format
/// or size.
cv::Mat toDisparityMap(const stereo_msgs::DisparityImage& message,
                       const vision::StereoCalibration& calibration);

/// What the message holds; orientation or rates whose covariance starts with -1 are absent (sensor_msgs/Imu),
/// and so is an orientation of norm 0. `time_s` is the header's stamp.
ImuSample toImuSample(const sensor_msgs::Imu& imu);

/// The same transform; the quaternion must be of norm 1.
Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform);

}  // namespace stereo_nav::ros_io
