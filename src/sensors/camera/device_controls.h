#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensors/camera/controls.h"
#include "sensors/camera/v4l2_descriptor.h"

namespace stereo_nav::camera {

/// The controls of one open camera: which there are, their values, and setting them.
class DeviceControls {
 public:
  /// `descriptor` must outlive this object.
  explicit DeviceControls(const V4l2Descriptor& descriptor) : descriptor_(descriptor) {}

  /// Asked from the driver on first use.
  const std::vector<Control>& list();
  /// The control whose old or new name is `name`; nullptr when the camera has none.
  const Control* find(const std::string& name) { return findControl(list(), name); }

  std::int32_t get(const Control& control) const;
  /// The control's value, or nothing if the camera has no such control.
  std::optional<std::int32_t> get(const std::string& name);
  /// Returns the value that the driver then has. Throws CaptureError when it refuses.
  std::int32_t set(const Control& control, std::int32_t value) const;

  /// Sets all of these, automatic modes first. Returns a warning for each that the camera does not have,
  /// refuses or sets to another value. Throws CaptureError only where the camera has gone.
  std::vector<std::string> apply(const std::vector<ControlSetting>& settings);

 private:
  std::vector<std::string> menuOf(const Control& control) const;

  const V4l2Descriptor& descriptor_;
  std::optional<std::vector<Control>> controls_;
};

}  // namespace stereo_nav::camera
