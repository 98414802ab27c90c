#pragma once

#include <nodelet/loader.h>

#include "ros/camera_info_gate.h"
#include "ros/stereo_processing.h"

namespace stereo_nav::ros_io {

/// Reads a node's parameters of the disparity: the file `~disparity_config`, overlaid by section `disparity`
/// of the rig file. Throws ParameterError.
ros_io::DisparityParams readDisparityParams(const ros::NodeHandle& private_handle);

/// The chain from raw images to rectified images and disparity, as nodelets in this process:
/// image_proc/debayer and image_proc/rectify for each camera, stereo_image_proc/disparity for both. The name
/// of each nodelet is that of the node with a suffix (e.g. /stereo_capture_disparity), and its parameters are
/// below that name. They get their camera_infos through a CameraInfoGate. The loader is a nodelet manager,
/// into which other nodelets can be loaded, too.
class ImageProcLoader {
 public:
  /// `exact_stamps`: whether left and right images carry equal stamps. Throws a std::runtime_error that names
  /// the nodelet that cannot be loaded.
  ImageProcLoader(bool exact_stamps, const ros_io::DisparityParams& disparity);

 private:
  void load(const std::string& suffix, const std::string& type, const nodelet::M_string& remappings);
  void loadCamera(const std::string& side);

  CameraInfoGate gate_;
  nodelet::Loader loader_;
};

}  // namespace stereo_nav::ros_io
