#pragma once

#include <nodelet/loader.h>

#include "ros/stereo_processing.h"

namespace stereo_nav::ros_io {

/// The disparity's parameters of a node: file `~disparity_config`, overlaid by section `disparity` of the rig
/// file. Throws ParameterError.
ros_io::DisparityParams readDisparityParams(const ros::NodeHandle& private_handle);

/// The chain from raw images to rectified ones and disparity, as nodelets in this process: image_proc/debayer
/// and image_proc/rectify for each camera, stereo_image_proc/disparity for both. Each has a name of its own,
/// that of the node with a suffix (e.g. /stereo_capture_disparity), below which its parameters are. The
/// loader is a nodelet manager, into which others can load, too.
class ImageProcLoader {
 public:
  /// `exact_stamps`: whether left and right images carry equal stamps. Throws std::runtime_error that names
  /// the nodelet which cannot be loaded.
  ImageProcLoader(bool exact_stamps, const ros_io::DisparityParams& disparity);

 private:
  void load(const std::string& suffix, const std::string& type, const nodelet::M_string& remappings);
  void loadCamera(const std::string& side);

  nodelet::Loader loader_;
};

}  // namespace stereo_nav::ros_io
