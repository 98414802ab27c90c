#include "kinematics/drive_file.h"

#include <fmt/format.h>

#include <set>

#include "kinematics/drive.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::kinematics {
namespace {

constexpr const char* kExample =
    "; a differential drive looks like this: `drive: {wheels: 2, "
    "wheel_1: {name: left, kind: fixed, y_m: 0.2, radius_m: 0.05, pulses_per_turn: 1024}, "
    "wheel_2: {name: right, kind: fixed, y_m: -0.2, radius_m: 0.05, pulses_per_turn: 1024}}`";

std::string wheelName(std::size_t index) {
  return "wheel_" + std::to_string(index + 1);
}

/// Defaults are right for most values, but no radius and no encoder is like another.
void requireValues(const YAML::Node& section, const std::string& source, std::size_t wheels) {
  for (std::size_t i = 0; i < wheels; ++i) {
    const YAML::Node wheel = section[wheelName(i)];
    if (!wheel.IsDefined()) {
      throw ParameterError(source + "." + wheelName(i) + " is missing, but `wheels` is " +
                           std::to_string(wheels) + "; describe the wheel or correct `wheels`");
    }
    for (const char* name : {"radius_m", "pulses_per_turn"}) {
      if (wheel.IsMap() && wheel[name].IsDefined()) continue;
      throw ParameterError(source + "." + wheelName(i) + "." + name +
                           " is missing; it differs from robot to robot, so that there is no default");
    }
  }
}

void refuseEqualNames(const DriveParams& drive, const std::string& source) {
  std::set<std::string> names;
  for (const auto& wheel : drive.wheels) {
    if (names.insert(wheel.name).second) continue;
    throw ParameterError(source + ": two wheels have the name '" + wheel.name +
                         "', by which messages tell them apart; give each its own");
  }
}

std::string kindName(WheelKind kind) {
  return kind == WheelKind::kRollers ? "rollers" : kind == WheelKind::kFixed ? "fixed" : "steered";
}

}  // namespace

DriveParams readDrive(const RigFile& rig) {
  const YAML::Node section = rig.section(rig_sections::kDrive);
  const std::string source = rig.sectionName(rig_sections::kDrive);
  if (section.IsNull())
    throw ParameterError(source + " is missing, so that nothing tells where the wheels are" + kExample);
  DriveParams drive;
  readParameters(section, source, drive);
  if (drive.wheels.empty())
    throw ParameterError(source + " has no wheels: `wheels` is missing or 0" + kExample);
  requireValues(section, source, drive.wheels.size());
  refuseEqualNames(drive, source);
  try {
    Drive checked(drive);
  } catch (const ParameterError& error) {
    throw ParameterError(source + ": " + error.what());
  }
  return drive;
}

void writeDrive(const DriveParams& drive, RigFile& rig) {
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    const WheelParams& wheel = drive.wheels[i];
    const auto set = [&](const char* name, const std::string& value) {
      rig.setNumber({rig_sections::kDrive, wheelName(i), name}, value);
    };
    set("x_m", fmt::format("{:.6f}", wheel.x_m));
    set("y_m", fmt::format("{:.6f}", wheel.y_m));
    set("direction_deg", fmt::format("{:.4f}", wheel.direction_deg));
    set("radius_m", fmt::format("{:.7f}", wheel.radius_m));
  }
}

std::string driveSection(const DriveParams& drive) {
  std::string text = fmt::format("{}:\n  wheels: {}\n", rig_sections::kDrive, drive.wheels.size());
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    const WheelParams& wheel = drive.wheels[i];
    text += fmt::format(
        "  {}:\n    name: {}\n    kind: {}\n    x_m: {:.6f}\n    y_m: {:.6f}\n    direction_deg: {:.4f}\n    radius_m: "
        "{:.7f}\n    pulses_per_turn: {}\n    encoder_reversed: {}\n",
        wheelName(i), wheel.name, kindName(wheel.kind), wheel.x_m, wheel.y_m, wheel.direction_deg,
        wheel.radius_m, wheel.pulses_per_turn, wheel.encoder_reversed);
    if (wheel.kind == WheelKind::kRollers) text += fmt::format("    roller_deg: {}\n", wheel.roller_deg);
    if (wheel.kind == WheelKind::kSteered)
      text += fmt::format("    max_steering_deg: {}\n", wheel.max_steering_deg);
  }
  return text;
}

}  // namespace stereo_nav::kinematics
