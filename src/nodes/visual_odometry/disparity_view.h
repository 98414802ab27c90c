#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <stereo_msgs/DisparityImage.h>

namespace stereo_nav::nodes {

/// camera/disparity in colours on vo/disparity_view, since rviz cannot show a DisparityImage. Whether the
/// odometry itself uses the disparity plays no part: it is subscribed, and so computed, only while somebody
/// looks.
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
