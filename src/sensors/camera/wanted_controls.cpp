#include "sensors/camera/wanted_controls.h"

namespace stereo_nav::camera {

void WantedControls::set(const std::string& name, std::int32_t value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  setIn(wanted_, {name, value});
  setIn(new_, {name, value});
}

std::vector<ControlSetting> WantedControls::takeAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  new_.clear();
  return wanted_;
}

std::vector<ControlSetting> WantedControls::takeNew() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(new_, {});
}

}  // namespace stereo_nav::camera
