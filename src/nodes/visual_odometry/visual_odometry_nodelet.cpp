// The visual_odometry node as a nodelet: in the manager of the image nodelets, images are passed without a
// copy.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "nodes/visual_odometry/visual_odometry_node.h"
#include "ros/master_watch.h"

namespace stereo_nav::nodes {

class VisualOdometryNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      master_ = std::make_unique<ros_io::MasterWatch>();
      node_ = std::make_unique<VisualOdometryNode>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<ros_io::MasterWatch> master_;  ///< the manager does not watch the master itself
  std::unique_ptr<VisualOdometryNode> node_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::VisualOdometryNodelet, nodelet::Nodelet)
