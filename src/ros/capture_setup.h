#pragma once

#include <string>
#include <vector>

#include "ros/parameter_server.h"
#include "sensors/camera/capture_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

/// Parameters of one of the two cameras.
struct CameraSource {
  std::string device;
  std::string calibration;

  void describe(ParameterVisitor& visitor);
};

/// Parameters of stereo_capture, in its private namespace and in section `cameras` of a rig file. Those of
/// the capture are among them, without a section.
struct StereoCaptureParams {
  camera::CaptureParams capture;
  CameraSource left;
  CameraSource right;
  std::string frame_id = ros_io::frames::kLeftOptical;
  bool load_image_proc = true;

  void describe(ParameterVisitor& visitor);
};

/// The parameters and the V4L2 controls. The controls have the names that the cameras' drivers give them, and
/// are set in the maps `controls` (both cameras), `left/controls` and `right/controls`.
struct CaptureSetup {
  StereoCaptureParams params;
  std::vector<camera::ControlSetting> left_controls, right_controls;

  /// Overlays the values of the sources. Throws ParameterError.
  void read(const std::vector<ros_io::ParameterSource>& sources);

  /// Settings with which to open the cameras. Throws ParameterError if a device is not set or both are the
  /// same.
  camera::StereoConfig toConfig() const;
};

}  // namespace stereo_nav::ros_io
