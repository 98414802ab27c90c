#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "sensors/camera/controls.h"

namespace stereo_nav::camera {

/// The control values that a camera is to have, set from any thread and taken by the camera's own.
class WantedControls {
 public:
  explicit WantedControls(std::vector<ControlSetting> settings) : wanted_(std::move(settings)) {}

  void set(const std::string& name, std::int32_t value);
  /// All settings, for a camera that was just opened.
  std::vector<ControlSetting> takeAll();
  /// Those set since the last call of either function.
  std::vector<ControlSetting> takeNew();

 private:
  std::mutex mutex_;
  std::vector<ControlSetting> wanted_;
  std::vector<ControlSetting> new_;
};

}  // namespace stereo_nav::camera
