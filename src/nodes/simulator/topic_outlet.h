#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <map>
#include <string>

namespace stereo_nav::nodes {

/// Publishes messages by the names of their topics, which must have been advertised.
class TopicOutlet {
 public:
  explicit TopicOutlet(const ros::NodeHandle& handle) : handle_(handle), transport_(handle) {}

  template <class Message>
  void advertise(const std::string& topic, bool is_latched = false) {
    publishers_[topic] = handle_.advertise<Message>(topic, kQueue, is_latched);
  }
  void advertiseImage(const std::string& topic) { images_[topic] = transport_.advertise(topic, kQueue); }

  template <class Message>
  void write(const std::string& topic, const ros::Time& /*time*/, const Message& message) {
    publishers_.at(topic).publish(message);
  }
  void write(const std::string& topic, const ros::Time& /*time*/, const sensor_msgs::Image& image) {
    images_.at(topic).publish(image);
  }

 private:
  static constexpr std::uint32_t kQueue = 100;

  ros::NodeHandle handle_;
  image_transport::ImageTransport transport_;
  std::map<std::string, ros::Publisher> publishers_;
  std::map<std::string, image_transport::Publisher> images_;
};

}  // namespace stereo_nav::nodes
