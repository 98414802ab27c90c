#pragma once

#include <string>
#include <vector>

#include "ros/parameter_server.h"
#include "sensors/camera/capture_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

/// One of the two cameras.
struct CameraSource {
  std::string device;
  std::string calibration;

  void describe(ParameterVisitor& visitor);
};

/// Parameters of stereo_capture, in its private namespace and in section `cameras` of a rig file. Those of
/// the capture stand beside them without a section.
struct StereoCaptureParams {
  camera::CaptureParams capture;
  CameraSource left;
  CameraSource right;
  std::string frame_id = ros_io::frames::kLeftOptical;
  bool load_image_proc = true;

  void describe(ParameterVisitor& visitor);
};

/// The parameters and the V4L2 controls, whose names are the cameras' own: maps `controls` (of both cameras),
/// `left/controls` and `right/controls`.
struct CaptureSetup {
  StereoCaptureParams params;
  std::vector<camera::ControlSetting> left_controls, right_controls;

  /// Overlays what the sources hold. Throws ParameterError.
  void read(const std::vector<ros_io::ParameterSource>& sources);

  /// What the cameras are to be opened with. Throws ParameterError where a device is missing or both are the
  /// same.
  camera::StereoConfig toConfig() const;
};

}  // namespace stereo_nav::ros_io
