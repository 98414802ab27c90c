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

/// Geometry of the rectified pair from both camera_infos; where these hold binning or a roi, of the delivered
/// images. Throws InputError for everything on which image_geometry would abort the process or which it would
/// silently accept: differing frame ids or sizes, no stereo calibration (P[3] = 0), swapped cameras, NaN, an
/// uncalibrated camera (K all zero), an unknown lens model, another number of coefficients, a baseline in
/// another unit, matrices or a roi that do not fit the image.
vision::StereoCalibration toCalibration(const sensor_msgs::CameraInfo& left,
                                        const sensor_msgs::CameraInfo& right);

/// For each pixel of the rectified image the row of the raw image that it comes from, CV_32FC1; empty for
/// distortion models that image_proc does not support. Binning and a roi are not looked at.
cv::Mat rawRows(const sensor_msgs::CameraInfo& info);

/// Converts to a CV_8UC1 image. Accepts mono8, mono16 (full range scaled to 8 bit), rgb8, bgr8, rgba8, bgra8,
/// rgb16, bgr16, the Bayer patterns of 8 and 16 bits and yuv422. Throws InputError for any other encoding,
/// which the message names, and for data shorter than width, height and step imply. The data of mono8 are
/// shared with the message, not copied.
cv::Mat toMono8(const sensor_msgs::ImageConstPtr& image);

/// Disparity in px, CV_32FC1. Pixels that the map marks as unknown are set to -1; the map's own marker is one
/// less than the smallest disparity searched, which may be positive. Throws InputError for another format or
/// size.
cv::Mat toDisparityMap(const stereo_msgs::DisparityImage& message,
                       const vision::StereoCalibration& calibration);

/// Converts an IMU message. Quantities whose covariance starts with -1 are absent (sensor_msgs/Imu), and so
/// is an orientation of norm 0. `time_s` is the header's stamp.
ImuSample toImuSample(const sensor_msgs::Imu& imu);

/// Converts a transform. Its quaternion must have norm 1.
Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform);

}  // namespace stereo_nav::ros_io
