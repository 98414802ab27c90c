// Makes raw images of compressed ones, by the same decoder that evaluate uses.
#include <nodelet/nodelet.h>
#include <ros/ros.h>

#include <array>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "ros/recorded_image.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

class DecodedImagesNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    constexpr std::uint32_t kQueue = 20;  // as many as image_proc's queues hold (image_proc.launch)
    // Multi-threaded: both cameras are decoded at a time.
    ros::NodeHandle handle = getMTNodeHandle();
    const std::array<const char*, 2> images = {ros_io::topics::kLeftImage, ros_io::topics::kRightImage};
    for (std::size_t side = 0; side < images.size(); ++side) {
      publishers_[side] = handle.advertise<sensor_msgs::Image>(images[side], kQueue);
      subscribers_[side] = handle.subscribe<sensor_msgs::CompressedImage>(
          std::string(images[side]) + ros_io::topics::kCompressed, kQueue,
          [this, side](const sensor_msgs::CompressedImageConstPtr& image) { decode(side, *image); });
    }
  }

  void decode(std::size_t side, const sensor_msgs::CompressedImage& image) {
    try {
      publishers_[side].publish(ros_io::decompressed(image));
    } catch (const InputError& error) {
      NODELET_ERROR_THROTTLE(10.0, "%s: %s", subscribers_[side].getTopic().c_str(), error.what());
    }
  }

  std::array<ros::Publisher, 2> publishers_;
  std::array<ros::Subscriber, 2> subscribers_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::DecodedImagesNodelet, nodelet::Nodelet)
