#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stereo_nav::camera {

/// One control of a camera, as VIDIOC_QUERYCTRL describes it.
struct Control {
  std::string name;  ///< as v4l2-ctl writes it, e.g. `exposure_time_absolute`
  std::uint32_t id = 0;
  std::uint32_t type = 0;  ///< V4L2_CTRL_TYPE_...
  std::uint32_t flags = 0;
  std::int32_t minimum = 0;
  std::int32_t maximum = 0;
  std::int32_t step = 1;
  std::int32_t default_value = 0;
  std::vector<std::string> menu;  ///< "index: text" of each entry
};

/// The value that a control shall have.
struct ControlSetting {
  std::string name;
  std::int32_t value = 0;
};

/// The driver's description in the form that v4l2-ctl uses: "Exposure, Auto Priority" ->
/// exposure_auto_priority.
std::string controlName(const std::string& description);

/// All names of the control, beginning with `name` itself. Linux 5.13 renamed several controls, e.g.
/// exposure_auto to auto_exposure.
std::vector<std::string> controlAliases(const std::string& name);

/// The control whose old or new name is `name`; nullptr when the camera has none.
const Control* findControl(const std::vector<Control>& controls, const std::string& name);

/// Puts automatic modes first: a camera refuses or ignores a manual value while its automatic mode is on.
std::vector<ControlSetting> inOrderOfSetting(std::vector<ControlSetting> settings);

/// Replaces the setting of the same control, whether given by its old or its new name, or adds it.
void setIn(std::vector<ControlSetting>& settings, const ControlSetting& setting);

}  // namespace stereo_nav::camera
