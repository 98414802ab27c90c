#pragma once

#include "sensors/camera/stereo_camera.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::camera {

/// What the user sets for both cameras alike. Devices, controls and calibrations are parameters of the node.
struct CaptureParams {
  enum class Stamps { kCommon, kTrue };

  int width = 640;
  int height = 480;
  double rate_hz = 30.0;
  PixelFormat format = PixelFormat::kAny;
  Encoding encoding = Encoding::kBgr8;
  int buffers = 4;
  double stall_timeout_s = 1.0;
  double max_time_offset_s = 0.02;
  Stamps stamps = Stamps::kCommon;
  double exposure_ms = -1.0;  ///< negative: left as it is; 0: automatic
  int gain = -1;              ///< negative: left as it is
  bool match_exposure = false;
  double rolling_shutter_ms = 0.0;

  void describe(ParameterVisitor& visitor);

  /// The configuration of the two cameras, without devices and controls.
  StereoConfig toConfig() const;
};

/// The settings of the controls that `exposure_ms` and `gain` stand for; none where they are negative.
std::vector<ControlSetting> exposureControls(double exposure_ms, int gain);

}  // namespace stereo_nav::camera
