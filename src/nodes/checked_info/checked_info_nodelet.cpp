// Keeps calibrations from the image nodelets that would end their process, or that they would misread.
#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "ros/camera_info_gate.h"

namespace stereo_nav::nodes {

class CheckedInfoNodelet : public nodelet::Nodelet {
 private:
  void onInit() override { gate_ = std::make_unique<ros_io::CameraInfoGate>(getNodeHandle(), getName()); }

  std::unique_ptr<ros_io::CameraInfoGate> gate_;
};

}  // namespace stereo_nav::nodes

PLUGINLIB_EXPORT_CLASS(stereo_nav::nodes::CheckedInfoNodelet, nodelet::Nodelet)
