// What CameraWorker does with the camera's controls.
#include <linux/videodev2.h>

#include <cerrno>
#include <string>
#include <vector>

#include "sensors/camera/camera_worker.h"

namespace stereo_nav::camera {
namespace {

constexpr double kExposureUnit_s = 100e-6;  // of V4L2_CID_EXPOSURE_ABSOLUTE

std::optional<std::int32_t> readIfPresent(V4l2Device& device, const std::string& name) {
  const Control* control = findControl(device.controls(), name);
  if (control == nullptr) return std::nullopt;
  return device.getControl(*control);
}

bool exposureIsManual(V4l2Device& device) {
  const auto mode = readIfPresent(device, "auto_exposure");
  return !mode || *mode == V4L2_EXPOSURE_MANUAL || *mode == V4L2_EXPOSURE_SHUTTER_PRIORITY;
}

}  // namespace

void CameraWorker::setControl(const std::string& name, std::int32_t value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  setIn(wanted_controls_, {name, value});
  setIn(pending_controls_, {name, value});
}

void CameraWorker::applyControls(V4l2Device& device, const std::vector<ControlSetting>& settings) {
  std::vector<std::string> warnings;
  for (const auto& setting : inOrderOfSetting(settings)) {
    const Control* control = findControl(device.controls(), setting.name);
    if (control == nullptr) {
      warnings.push_back(setting.name + ": the camera has no such control");
      continue;
    }
    try {
      const std::int32_t active = device.setControl(*control, setting.value);
      if (active != setting.value) {
        warnings.push_back(control->name + " = " + std::to_string(setting.value) + ": the camera set " +
                           std::to_string(active) + " (allowed: " + std::to_string(control->minimum) +
                           " to " + std::to_string(control->maximum) + ")");
      }
    } catch (const CaptureError& error) {
      if (error.errorNumber() == ENODEV) throw;
      warnings.push_back(error.what());
    }
  }
  for (const auto& warning : warnings) log_(Severity::Warning, config_.name + " camera: " + warning);
  update([&](CameraStatus& status) {
    status.control_warnings.insert(status.control_warnings.end(), warnings.begin(), warnings.end());
  });
}

void CameraWorker::applyPendingControls(V4l2Device& device) {
  std::vector<ControlSetting> pending;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    pending.swap(pending_controls_);
  }
  if (pending.empty()) return;
  applyControls(device, pending);
  next_exposure_reading_ns_ = 0;
  automatic_exposure_.reset();  // what changes now does not change by itself
}

/// Whether `exposure` is the one in use. In automatic modes many cameras report the last manual one; only a
/// control that is marked as changing by itself, or was seen to, is believed then.
bool CameraWorker::exposureIsTold(V4l2Device& device, std::int32_t exposure) {
  if (exposureIsManual(device)) {
    automatic_exposure_.reset();
    return true;
  }
  if (automatic_exposure_ && *automatic_exposure_ != exposure) exposure_changes_by_itself_ = true;
  automatic_exposure_ = exposure;
  const Control* control = findControl(device.controls(), "exposure_time_absolute");
  return exposure_changes_by_itself_ || (control->flags & V4L2_CTRL_FLAG_VOLATILE) != 0;
}

void CameraWorker::readExposure(V4l2Device& device) {
  auto exposure = readIfPresent(device, "exposure_time_absolute");
  auto gain = readIfPresent(device, "gain");
  const bool untold = exposure && !exposureIsTold(device, *exposure);
  if (untold) exposure = gain = std::nullopt;
  exposure_s_.reset();
  if (exposure) exposure_s_ = *exposure * kExposureUnit_s;
  update([&](CameraStatus& status) {
    status.exposure = exposure;
    status.gain = gain;
    status.exposure_untold = untold;
  });
}

}  // namespace stereo_nav::camera
