#include "ros/image_proc_loader.h"

#include <ros/ros.h>

#include <stdexcept>

#include "core/rig_file.h"
#include "ros/parameter_server.h"

namespace stereo_nav::ros_io {
namespace {

/// More threads than cores, because image_proc/debayer queues a single image and loses it while all threads
/// are busy with disparity.
constexpr int kThreads = 8;
/// With the nodelets' default of 5, images are lost under short load peaks.
constexpr int kQueue = 20;

/// Must be called before the loader reads the parameter.
bool setDefaultThreads() {
  const ros::NodeHandle private_handle("~");
  if (!private_handle.hasParam("num_worker_threads")) private_handle.setParam("num_worker_threads", kThreads);
  return true;
}

std::string resolve(const std::string& topic) {
  return ros::names::resolve(topic);
}

}  // namespace

ros_io::DisparityParams readDisparityParams(const ros::NodeHandle& private_handle) {
  ros_io::DisparityParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "disparity_config"),
                          ros_io::rigSource(private_handle, rig_sections::kDisparity)},
                         params);
  return params;
}

ImageProcLoader::ImageProcLoader(bool exact_stamps, const ros_io::DisparityParams& disparity_params)
    : gate_(ros::NodeHandle(), ros::this_node::getName()), loader_(setDefaultThreads()) {
  loadCamera("left");
  loadCamera("right");
  const ros::NodeHandle disparity(ros::this_node::getName() + "_disparity");
  ros_io::writeParameters(disparity, disparity_params);
  disparity.setParam("approximate_sync", !exact_stamps);
  nodelet::M_string remappings = {{"disparity", resolve("camera/disparity")}};
  for (const std::string side : {"left", "right"}) {
    remappings[side + "/image_rect"] = resolve("camera/" + side + "/image_rect");
    remappings[side + "/camera_info"] = resolve("camera/" + side + "/checked_info");
  }
  load("_disparity", "stereo_image_proc/disparity", remappings);
}

void ImageProcLoader::loadCamera(const std::string& side) {
  const std::string camera = "camera/" + side + "/";
  load("_debayer_" + side, "image_proc/debayer",
       {{"image_raw", resolve(camera + "image_raw")},
        {"image_mono", resolve(camera + "image_mono")},
        {"image_color", resolve(camera + "image_color")}});
  load("_rectify_" + side, "image_proc/rectify",
       {{"image_mono", resolve(camera + "image_mono")},
        {resolve(camera + "camera_info"), resolve(camera + "checked_info")},
        {"image_rect", resolve(camera + "image_rect")}});
  load("_rectify_color_" + side, "image_proc/rectify",
       {{"image_mono", resolve(camera + "image_color")},
        {resolve(camera + "camera_info"), resolve(camera + "checked_info")},
        {"image_rect", resolve(camera + "image_rect_color")}});
}

void ImageProcLoader::load(const std::string& suffix, const std::string& type,
                           const nodelet::M_string& remappings) {
  const std::string name = ros::this_node::getName() + suffix;
  const ros::NodeHandle parameters(name);
  if (!parameters.hasParam("queue_size")) parameters.setParam("queue_size", kQueue);
  if (loader_.load(name, type, remappings, {})) return;
  throw std::runtime_error(
      "the nodelet " + type +
      " cannot be loaded (the lines above say why); install image_proc and stereo_image_proc, or "
      "run without: _load_image_proc:=false");
}

}  // namespace stereo_nav::ros_io
