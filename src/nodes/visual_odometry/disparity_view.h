#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <stereo_msgs/DisparityImage.h>

namespace stereo_nav::nodes {

/// camera/disparity in colours on vo/disparity_view, since rviz cannot show a DisparityImage. Independent of
/// whether the odometry uses the disparity: this view subscribes to it, and so has it computed, only while
/// the view has subscribers.
class DisparityView {
 public:
  explicit DisparityView(const ros::NodeHandle& handle);

 private:
  void followSubscribers();
  void handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);

  ros::NodeHandle handle_;
  image_transport::ImageTransport transport_;
  image_transport::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
