#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <mutex>
#include <string>

#include "sensors/camera/frame.h"

namespace stereo_nav::nodes {

/// One camera's topics, `image_raw` and `camera_info`, and its calibration with the service
/// `set_camera_info`. Images are published without a calibration, too; camera_info then holds only their
/// size.
class CameraPublisher {
 public:
  /// `handle` is that of the camera's namespace, e.g. camera/left. An empty `calibration_url` means
  /// file://${ROS_HOME}/camera_info/<name>.yaml, to which the calibration service saves.
  CameraPublisher(const ros::NodeHandle& handle, const std::string& name, const std::string& calibration_url,
                  const std::string& frame_id);

  /// Publishes an image; takes over its memory.
  void publish(camera::Frame& frame, const ros::Time& stamp);

  /// The problem with the calibration for images of this size, with the remedy; empty when there is none.
  std::string calibrationProblem(int width, int height);
  /// The calibration, with the frame of the images.
  sensor_msgs::CameraInfo calibration();
  /// A warning about a calibration that is valid in itself, with the remedy; empty when there is none.
  std::string calibrationWarning() const;

 private:
  std::string urlText();

  image_transport::ImageTransport transport_;
  image_transport::CameraPublisher publisher_;
  std::string name_;
  std::string url_;
  std::string frame_id_;
  camera_info_manager::CameraInfoManager calibration_;
};

}  // namespace stereo_nav::nodes
