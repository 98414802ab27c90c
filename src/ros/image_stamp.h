#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <sensor_msgs/Image.h>

namespace stereo_nav::ros_io {

/// The stamp of a recorded sensor_msgs/Image, which is read without deserialising the pixels.
struct ImageStamp {
  ros::Time stamp;
};

}  // namespace stereo_nav::ros_io

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<stereo_nav::ros_io::ImageStamp> : MD5Sum<sensor_msgs::Image> {
  static const char* value() { return MD5Sum<sensor_msgs::Image>::value(); }
  static const char* value(const stereo_nav::ros_io::ImageStamp&) {
    return MD5Sum<sensor_msgs::Image>::value();
  }
};

template <>
struct DataType<stereo_nav::ros_io::ImageStamp> : DataType<sensor_msgs::Image> {
  static const char* value() { return DataType<sensor_msgs::Image>::value(); }
  static const char* value(const stereo_nav::ros_io::ImageStamp&) {
    return DataType<sensor_msgs::Image>::value();
  }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<stereo_nav::ros_io::ImageStamp> {
  template <class Stream>
  static void read(Stream& stream, stereo_nav::ros_io::ImageStamp& image) {
    std_msgs::Header header;  // the first field of an image
    stream.next(header);
    image.stamp = header.stamp;
  }
};

}  // namespace serialization
}  // namespace ros
