#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <string>

namespace stereo_nav::test {

/// Writes one message of a recording to a copy.
using CopyMessage = std::function<void(const rosbag::MessageInstance&, rosbag::Bag&)>;

inline void copyBag(const std::string& from, const std::string& to, rosbag::bagmode::BagMode mode,
                    const CopyMessage& copy_message) {
  rosbag::Bag source(from);
  rosbag::Bag copy(to, mode);
  rosbag::View view(source);
  for (const rosbag::MessageInstance& message : view) copy_message(message, copy);
}

/// Copies a recording; `change` may edit images, `rename` gives the topics, an empty one leaves them out.
inline void copyBag(const std::string& from, const std::string& to, rosbag::bagmode::BagMode mode,
                    const std::function<std::string(const std::string&)>& rename,
                    const std::function<void(sensor_msgs::Image&)>& change) {
  copyBag(from, to, mode, [&](const rosbag::MessageInstance& message, rosbag::Bag& copy) {
    const std::string topic = rename(message.getTopic());
    if (topic.empty()) return;
    if (const auto image = message.instantiate<sensor_msgs::Image>()) {
      change(*image);
      copy.write(topic, message.getTime(), *image);
    } else {
      copy.write(topic, message.getTime(), message);
    }
  });
}

}  // namespace stereo_nav::test
