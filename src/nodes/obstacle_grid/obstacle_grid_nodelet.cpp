// The obstacle_grid node as a nodelet: in the manager of the image nodelets, disparity images are passed
// without a copy.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "nodes/obstacle_grid/obstacle_grid_node.h"
#include "ros/master_watch.h"

namespace stereo_nav::nodes {

class ObstacleGridNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      master_ = std::make_unique<ros_io::MasterWatch>();
      node_ = std::make_unique<ObstacleGridNode>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<ros_io::MasterWatch> master_;  ///< the manager does not watch the master itself
  std::unique_ptr<ObstacleGridNode> node_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::ObstacleGridNodelet, nodelet::Nodelet)
