#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "nodes/stereo_capture/camera_publisher.h"
#include "nodes/stereo_capture/capture_diagnostics.h"
#include "ros/capture_setup.h"
#include "ros/image_proc_loader.h"
#include "ros/live_parameters.h"
#include "ros/problem_list.h"
#include "sensors/camera/clock_mapping.h"
#include "sensors/camera/stereo_camera.h"

namespace stereo_nav::nodes {

/// Reads two cameras and publishes pairs of images: camera/{left,right}/{image_raw,camera_info} and
/// camera/sync.
class StereoCaptureNode {
 public:
  /// Reads all parameters. Throws ParameterError.
  StereoCaptureNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~StereoCaptureNode();

 private:
  void publish(camera::StereoImages images);
  void publishSync(const camera::StereoImages& images, const ros::Time& left, const ros::Time& right);
  void followSystemClock();
  void applyLive(const camera::CaptureParams& params);
  void handleTimer(const ros::WallTimerEvent&);
  /// Says a problem when it comes up, and again from time to time, and when it is over.
  void tell(const std::string& key, const std::string& problem, const std::string& solved);
  std::string calibrationProblem(camera::Side side) {
    return publisherOf(side).calibrationProblem(params_.width, params_.height);
  }
  /// Why the two calibrations are none of a stereo pair; empty when they are, or when one is unusable alone.
  std::string pairProblem();
  CameraPublisher& publisherOf(camera::Side side) {
    return side == camera::Side::kLeft ? left_publisher_ : right_publisher_;
  }

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  ros_io::CaptureSetup setup_;
  const camera::CaptureParams& params_;  ///< part of setup_
  const std::string& frame_id_;          ///< part of setup_
  CameraPublisher left_publisher_;
  CameraPublisher right_publisher_;
  ros::Publisher sync_publisher_;
  camera::ClockMapping clock_;
  ros_io::ProblemList problems_;
  std::unique_ptr<camera::StereoCamera> camera_;
  std::unique_ptr<CaptureDiagnostics> diagnostics_;
  std::unique_ptr<ros_io::ImageProcLoader> image_proc_;
  std::unique_ptr<ros_io::LiveParameters<ros_io::StereoCaptureParams>> live_parameters_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
