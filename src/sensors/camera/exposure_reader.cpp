#include "sensors/camera/exposure_reader.h"

#include <linux/videodev2.h>

namespace stereo_nav::camera {
namespace {

constexpr double kExposureUnit_s = 100e-6;  // unit of V4L2_CID_EXPOSURE_ABSOLUTE

bool exposureIsManual(DeviceControls& controls) {
  const auto mode = controls.get("auto_exposure");
  return !mode || *mode == V4L2_EXPOSURE_MANUAL || *mode == V4L2_EXPOSURE_SHUTTER_PRIORITY;
}

}  // namespace

std::optional<double> ExposureReading::exposure_s() const {
  if (!exposure) return std::nullopt;
  return *exposure * kExposureUnit_s;
}

/// Whether `exposure` is the one in use. In automatic modes only a control that is marked as changing by
/// itself, or was seen to, is believed.
bool ExposureReader::isTold(DeviceControls& controls, std::int32_t exposure) {
  if (exposureIsManual(controls)) {
    automatic_exposure_.reset();
    return true;
  }
  if (automatic_exposure_ && *automatic_exposure_ != exposure) changes_by_itself_ = true;
  automatic_exposure_ = exposure;
  const Control* control = controls.find("exposure_time_absolute");
  return changes_by_itself_ || (control->flags & V4L2_CTRL_FLAG_VOLATILE) != 0;
}

ExposureReading ExposureReader::read(DeviceControls& controls) {
  ExposureReading reading;
  reading.exposure = controls.get("exposure_time_absolute");
  reading.gain = controls.get("gain");
  reading.untold = reading.exposure && !isTold(controls, *reading.exposure);
  if (reading.untold) reading.exposure = reading.gain = std::nullopt;
  return reading;
}

}  // namespace stereo_nav::camera
