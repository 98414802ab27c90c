#include "sensors/camera/capture_params.h"

#include <linux/videodev2.h>

#include <cmath>

namespace stereo_nav::camera {

void CaptureParams::describe(ParameterVisitor& visitor) {
  visitor.integer("width", width, {16, 8192}, "px", "image width, one that both cameras offer");
  visitor.integer("height", height, {16, 8192}, "px", "image height");
  visitor.real("rate_hz", rate_hz, {0.1, 1000.0}, "Hz", "frame rate asked from both cameras");
  visitEnum(visitor, "format", format,
            {{"any", PixelFormat::kAny},
             {"mjpg", PixelFormat::kMjpg},
             {"yuyv", PixelFormat::kYuyv},
             {"uyvy", PixelFormat::kUyvy},
             {"grey", PixelFormat::kGrey},
             {"nv12", PixelFormat::kNv12}},
            "what the cameras send; any takes the first of the others, in this order, that a camera has");
  visitEnum(visitor, "encoding", encoding, {{"bgr8", Encoding::kBgr8}, {"mono8", Encoding::kMono8}},
            "encoding of the published images; mono8 needs about half the time");
  visitor.integer("buffers", buffers, {2, 32}, "", "image buffers asked from each driver");
  visitor.real("stall_timeout_s", stall_timeout_s, {0.1, 60.0}, "s",
               "a camera that sends nothing for so long is opened again");
  visitor.real(
      "max_time_offset_s", max_time_offset_s, {0.0, 1.0}, "s",
      "left and right images further apart in time are not paired; half the frame period loses no image",
      Change::kLive);
  visitEnum(visitor, "stamps", stamps, {{"common", Stamps::kCommon}, {"true", Stamps::kTrue}},
            "common: both images of a pair carry the time of the left one; true: each image carries its own");
  visitor.real("exposure_ms", exposure_ms, {-1.0, 1000.0}, "ms",
               "exposure time of both cameras; 0: automatic, -1: unchanged", Change::kLive);
  visitor.integer("gain", gain, {-1, 10000}, "", "gain of both cameras in the driver's units; -1: unchanged",
                  Change::kLive);
  visitor.flag("match_exposure", match_exposure,
               "the right camera follows the exposure time and gain that the left one reports");
  visitor.real("rolling_shutter_ms", rolling_shutter_ms, {0.0, 200.0}, "ms",
               "time from the first row of an image to its last, for both cameras; 0: global shutter");
}

StereoConfig CaptureParams::toConfig() const {
  StereoConfig config;
  config.left.name = "left";
  config.left.format = {format, width, height, rate_hz};
  config.left.encoding = encoding;
  config.left.buffers = buffers;
  config.left.stall_timeout_s = stall_timeout_s;
  config.left.rolling_shutter_s = 1e-3 * rolling_shutter_ms;
  config.right = config.left;
  config.right.name = "right";
  config.max_time_offset_s = max_time_offset_s;
  config.match_exposure = match_exposure;
  return config;
}

std::vector<ControlSetting> exposureControls(double exposure_ms, int gain) {
  constexpr double kUnitsPerMs = 10.0;  // V4L2 counts exposure in 100 us
  std::vector<ControlSetting> settings;
  if (exposure_ms == 0.0) settings.push_back({"auto_exposure", V4L2_EXPOSURE_APERTURE_PRIORITY});
  if (exposure_ms > 0.0) {
    settings.push_back({"auto_exposure", V4L2_EXPOSURE_MANUAL});
    settings.push_back({"exposure_time_absolute", static_cast<int>(std::lround(exposure_ms * kUnitsPerMs))});
  }
  if (gain >= 0) settings.push_back({"gain", gain});
  return settings;
}

}  // namespace stereo_nav::camera
