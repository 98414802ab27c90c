#pragma once

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>

#include "stereo_nav/StereoCaptureConfig.h"
#include "stereo_nav/capture/clock_mapping.h"
#include "stereo_nav/capture/stereo_camera.h"
#include "stereo_nav/nodes/camera_publisher.h"
#include "stereo_nav/nodes/capture_diagnostics.h"
#include "stereo_nav/nodes/capture_setup.h"
#include "stereo_nav/nodes/image_proc_loader.h"
#include "stereo_nav/nodes/problem_list.h"

namespace stereo_nav::nodes {

/// Two cameras in, pairs of images out: camera/{left,right}/{image_raw,camera_info} and camera/sync.
class StereoCaptureNode {
 public:
  /// Reads all parameters. Throws ParameterError.
  StereoCaptureNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~StereoCaptureNode();

 private:
  void publish(capture::StereoImages images);
  void publishSync(const capture::StereoImages& images, const ros::Time& left, const ros::Time& right);
  void followSystemClock();
  void reconfigure(const StereoCaptureConfig& config);
  void handleTimer(const ros::WallTimerEvent&);
  void tellCalibrationProblem(capture::Side side);
  CameraPublisher& publisherOf(capture::Side side) {
    return side == capture::Side::Left ? left_publisher_ : right_publisher_;
  }

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  CaptureSetup setup_;
  const capture::CaptureParams& params_;  ///< of setup_
  const std::string& frame_id_;           ///< of setup_
  CameraPublisher left_publisher_;
  CameraPublisher right_publisher_;
  ros::Publisher sync_publisher_;
  capture::ClockMapping clock_;
  ProblemList problems_;
  std::unique_ptr<capture::StereoCamera> camera_;
  std::unique_ptr<CaptureDiagnostics> diagnostics_;
  std::unique_ptr<ImageProcLoader> image_proc_;
  std::unique_ptr<dynamic_reconfigure::Server<StereoCaptureConfig>> reconfigure_server_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
