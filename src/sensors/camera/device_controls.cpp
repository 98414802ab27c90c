#include "sensors/camera/device_controls.h"

#include <linux/videodev2.h>

#include <cerrno>

namespace stereo_nav::camera {
namespace {

/// Controls that hold one 32-bit number; the others (strings, matrices, headings) are of no use here.
bool holdsNumber(std::uint32_t type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN || type == V4L2_CTRL_TYPE_MENU ||
         type == V4L2_CTRL_TYPE_INTEGER_MENU || type == V4L2_CTRL_TYPE_BITMASK ||
         type == V4L2_CTRL_TYPE_BUTTON;
}

}  // namespace

const std::vector<Control>& DeviceControls::list() {
  if (!controls_) {
    controls_.emplace();
    v4l2_queryctrl query{};
    query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
    for (; descriptor_.call(VIDIOC_QUERYCTRL, &query) == 0; query.id |= V4L2_CTRL_FLAG_NEXT_CTRL) {
      if (!holdsNumber(query.type) || (query.flags & V4L2_CTRL_FLAG_DISABLED) != 0) continue;
      Control control;
      control.name = controlName(reinterpret_cast<const char*>(query.name));
      control.id = query.id;
      control.type = query.type;
      control.flags = query.flags;
      control.minimum = query.minimum;
      control.maximum = query.maximum;
      control.step = query.step;
      control.default_value = query.default_value;
      if (query.type == V4L2_CTRL_TYPE_MENU) control.menu = menuOf(control);
      controls_->push_back(std::move(control));
    }
  }
  return *controls_;
}

std::vector<std::string> DeviceControls::menuOf(const Control& control) const {
  std::vector<std::string> entries;
  for (std::int32_t item = control.minimum; item <= control.maximum; ++item) {
    v4l2_querymenu menu{};
    menu.id = control.id;
    menu.index = static_cast<std::uint32_t>(item);
    if (descriptor_.call(VIDIOC_QUERYMENU, &menu) == 0) {
      entries.push_back(std::to_string(item) + ": " + reinterpret_cast<const char*>(menu.name));
    }
  }
  return entries;
}

std::int32_t DeviceControls::get(const Control& control) const {
  v4l2_control value{};
  value.id = control.id;
  descriptor_.callOrThrow(VIDIOC_G_CTRL, &value, Step::kControl, "reading " + control.name);
  return value.value;
}

std::int32_t DeviceControls::set(const Control& control, std::int32_t value) const {
  v4l2_control setting{};
  setting.id = control.id;
  setting.value = value;
  descriptor_.callOrThrow(VIDIOC_S_CTRL, &setting, Step::kControl,
                          control.name + " = " + std::to_string(value));
  return control.type == V4L2_CTRL_TYPE_BUTTON ? value : get(control);
}

std::optional<std::int32_t> DeviceControls::get(const std::string& name) {
  const Control* control = find(name);
  if (control == nullptr) return std::nullopt;
  return get(*control);
}

std::vector<std::string> DeviceControls::apply(const std::vector<ControlSetting>& settings) {
  std::vector<std::string> warnings;
  for (const auto& setting : inOrderOfSetting(settings)) {
    const Control* control = find(setting.name);
    if (control == nullptr) {
      warnings.push_back(setting.name + ": the camera has no such control");
      continue;
    }
    try {
      const std::int32_t active = set(*control, setting.value);
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
  return warnings;
}

}  // namespace stereo_nav::camera
