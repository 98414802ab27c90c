// The ekf_localization node as a nodelet.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "nodes/ekf_localization/ekf_localization_node.h"
#include "ros/master_watch.h"

namespace stereo_nav::nodes {

class EkfLocalizationNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      master_ = std::make_unique<ros_io::MasterWatch>();
      node_ = std::make_unique<EkfLocalizationNode>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<ros_io::MasterWatch> master_;  ///< the manager does not watch the master itself
  std::unique_ptr<EkfLocalizationNode> node_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::EkfLocalizationNodelet, nodelet::Nodelet)
