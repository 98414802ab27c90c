#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "vision/bit_depth.h"

namespace stereo_nav::ros_io {

/// How the mono16 images of a topic and of another one fill their 16 bits, from images spread over the
/// recording; all 16 bits for other encodings.
vision::BitDepth recordedDepth(const rosbag::Bag& bag, const std::string& left, const std::string& right);

/// ros_io::toMono8() for images of a recording whose mono16 fills `depth` only.
cv::Mat toMono8(const sensor_msgs::ImageConstPtr& image, const vision::BitDepth& depth);

}  // namespace stereo_nav::ros_io
