#include "sensors/camera/controls.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace stereo_nav::camera {
namespace {

/// Names before Linux 5.13, and the names since.
const std::vector<std::pair<std::string, std::string>> kRenamed = {
    {"exposure_auto", "auto_exposure"},
    {"exposure_auto_priority", "exposure_dynamic_framerate"},
    {"exposure_absolute", "exposure_time_absolute"},
    {"white_balance_temperature_auto", "white_balance_automatic"},
    {"white_balance_auto", "white_balance_automatic"},
    {"focus_auto", "focus_automatic_continuous"},
    {"hue_auto", "hue_automatic"},
    {"gain_auto", "gain_automatic"},
    {"autogain", "gain_automatic"},
};

bool isAutomatic(const ControlSetting& setting) {
  return setting.name.find("auto") != std::string::npos;
}

}  // namespace

std::string controlName(const std::string& description) {
  std::string name;
  for (const char character : description) {
    const auto byte = static_cast<unsigned char>(character);
    if (std::isalnum(byte)) {
      name += static_cast<char>(std::tolower(byte));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

std::vector<std::string> controlAliases(const std::string& name) {
  std::vector<std::string> names = {name};
  for (const auto& [before, since] : kRenamed) {
    if (name == before) names.push_back(since);
    if (name == since) names.push_back(before);
  }
  return names;
}

const Control* findControl(const std::vector<Control>& controls, const std::string& name) {
  for (const auto& alias : controlAliases(name)) {
    const auto found = std::find_if(controls.begin(), controls.end(),
                                    [&alias](const Control& control) { return control.name == alias; });
    if (found != controls.end()) return &*found;
  }
  return nullptr;
}

std::vector<ControlSetting> inOrderOfSetting(std::vector<ControlSetting> settings) {
  std::stable_partition(settings.begin(), settings.end(), isAutomatic);
  return settings;
}

void setIn(std::vector<ControlSetting>& settings, const ControlSetting& setting) {
  const auto names = controlAliases(setting.name);
  const auto known = std::find_if(settings.begin(), settings.end(), [&names](const ControlSetting& other) {
    return std::find(names.begin(), names.end(), other.name) != names.end();
  });
  if (known == settings.end()) {
    settings.push_back(setting);
  } else {
    *known = setting;
  }
}

}  // namespace stereo_nav::camera
