#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "core/angles.h"
#include "core/text_table.h"
#include "kinematics/layouts.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/import_sequence/sequence.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

constexpr const char* kOmniPlaces[] = {"front_right", "front_left", "rear"};
constexpr double kOmniPlaces_deg[] = {-60.0, 60.0, 180.0};

std::string metadataOf(const std::string& run_file) {
  const std::string name = std::filesystem::path(run_file).filename().string();
  const auto end = name.rfind("_run-");
  if (end == std::string::npos)
    throw InputError(run_file + ": is no run of OptiOdom; give one of the files SET_run-NN.csv");
  return (std::filesystem::path(run_file).parent_path() / (name.substr(0, end) + "_metadata.csv")).string();
}

/// The rows of the metadata by their first field.
class Metadata {
 public:
  explicit Metadata(const std::string& path) : path_(path) {
    for (const TextRow& row : readTextTable(path)) rows_.emplace(row.fields[0], row);
  }

  const TextRow& row(const std::string& name) const {
    const auto found = rows_.find(name);
    if (found != rows_.end() && found->second.fields.size() > 1) return found->second;
    throw InputError(path_ + ": has no value of '" + name + "'; take the file as OptiOdom gives it");
  }
  double number(const std::string& name) const { return row(name).number(1); }

 private:
  std::string path_;
  std::map<std::string, TextRow> rows_;
};

/// Three omni wheels on a circle of the radius Li, which roll clockwise.
kinematics::DriveParams omniOf(const Metadata& metadata) {
  kinematics::DriveParams drive;
  for (std::size_t i = 0; i < 3; ++i) {
    const double place_rad = kOmniPlaces_deg[i] * kRadPerDeg;
    kinematics::WheelParams wheel;
    wheel.name = kOmniPlaces[i];
    wheel.x_m = metadata.number("Li") * std::cos(place_rad);
    wheel.y_m = metadata.number("Li") * std::sin(place_rad);
    wheel.direction_deg = kOmniPlaces_deg[i] - 90.0;
    drive.wheels.push_back(wheel);
  }
  return drive;
}

/// Two wheels on one axle, Li apart; the right one comes first.
kinematics::DriveParams differentialOf(const Metadata& metadata) {
  kinematics::DriveParams drive = kinematics::differentialDrive(metadata.number("Li"), 1.0);
  std::swap(drive.wheels[0], drive.wheels[1]);
  return drive;
}

kinematics::DriveParams driveOf(const std::string& path) {
  const Metadata metadata(path);
  const TextRow& type = metadata.row("type");
  kinematics::DriveParams drive;
  if (type.fields[1] == "omni3") {
    drive = omniOf(metadata);
  } else if (type.fields[1] == "diff") {
    drive = differentialOf(metadata);
  } else {
    throw InputError(
        type.source + ": the drive '" + type.fields[1] +
        "' is not known, only omni3 (three omni wheels) and diff (two wheels on one axle) are; bring "
        "recordings of others into a bag by a driver of your own that publishes wheel_ticks");
  }
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    drive.wheels[i].radius_m = 0.5 * metadata.row("Di").number(i + 1);
    drive.wheels[i].pulses_per_turn = metadata.number("ngear") * metadata.number("encRes");
  }
  validateParameters(drive, path);
  return drive;
}

}  // namespace

WheelSequence readOptiodom(const std::string& run_file) {
  WheelSequence sequence;
  sequence.drive = driveOf(metadataOf(run_file));
  std::vector<std::int64_t> pulses(sequence.drive.wheels.size(), 0);
  for (const TextRow& row : readTextTable(run_file)) {
    const double time_s = kStartTime_s + row.number(0);
    if (!sequence.readings.empty() && time_s <= sequence.readings.back().time_s)
      throw InputError(row.source + ": the time does not increase; take the file as OptiOdom gives it");
    for (std::size_t i = 0; i < pulses.size(); ++i) pulses[i] += row.integer(4 + i);
    sequence.readings.push_back({time_s, pulses});
    Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
    T_world_base.translation() << row.number(1), row.number(2), 0.0;
    T_world_base.rotate(Eigen::AngleAxisd(row.number(3), Eigen::Vector3d::UnitZ()));
    sequence.ground_truth.push_back({time_s, T_world_base});
  }
  if (sequence.readings.size() < 2)
    throw InputError(run_file + ": holds less than two rows; is the file complete?");
  return sequence;
}

}  // namespace stereo_nav::tools
