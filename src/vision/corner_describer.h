#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/descriptor.h"

namespace stereo_nav::vision {

/// Scales at which a corner is described: seen from half as far again it is found by another one of them.
constexpr double kDescriptorScales[] = {1.0, 1.5};

/// ORB descriptors of corners that exist already, at each of kDescriptorScales, in the order of Keyframe.
/// The orientation is that of the intensity centroid (Rosin 1999) in the circle of 31 px that ORB describes:
/// OpenCV computes it only for corners that it detects itself, and describes all others upright.
/// `image` is CV_8UC1; the corners lie inside of it.
std::vector<Descriptor> describeCorners(const cv::Mat& image, const std::vector<cv::Point2f>& corners);

/// Direction from a corner to the centroid of intensity around it, degrees from 0 to 360; what lies outside
/// of the image counts nothing.
float centroidDirection_deg(const cv::Mat& image, const cv::Point2f& corner);

/// Corners that ORB finds and describes on its own, over eight scales: for single images without odometry.
struct DescribedCorners {
  std::vector<cv::Point2f> px;
  std::vector<Descriptor> descriptors;  ///< one a corner
};
/// At most `most` corners of FAST threshold `threshold` (grey levels).
DescribedCorners detectAndDescribe(const cv::Mat& image, int most, int threshold);

}  // namespace stereo_nav::vision
