// The laser_odometry node as a nodelet.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "nodes/laser_odometry/laser_odometry_node.h"
#include "ros/master_watch.h"

namespace stereo_nav::nodes {

class LaserOdometryNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      master_ = std::make_unique<ros_io::MasterWatch>();
      node_ = std::make_unique<LaserOdometryNode>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<ros_io::MasterWatch> master_;  ///< the manager does not watch the master itself
  std::unique_ptr<LaserOdometryNode> node_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::LaserOdometryNodelet, nodelet::Nodelet)
