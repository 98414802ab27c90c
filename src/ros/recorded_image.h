#pragma once

#include <rosbag/message_instance.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <optional>

namespace stereo_nav::ros_io {

/// A compressed image (JPEG, PNG and what else OpenCV reads) as a plain one. Colours become grey; a Bayer
/// pattern that was compressed as it is stays one. The encoding is mono8, mono16 or bayer_*. Throws
/// InputError for data that cannot be decoded.
sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& image);

/// The recorded sensor_msgs/Image or CompressedImage as a plain image; null for other types.
sensor_msgs::ImageConstPtr recordedImage(const rosbag::MessageInstance& message);

/// Its stamp, without decoding the pixels; nothing for other types.
std::optional<ros::Time> recordedImageStamp(const rosbag::MessageInstance& message);

}  // namespace stereo_nav::ros_io
