#include "core/rig_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "core/optical_axes.h"
#include "core/roll_pitch_yaw.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav {
namespace {

constexpr std::array<const char*, 3> kAngles = {"roll_deg", "pitch_deg", "yaw_deg"};

void refuseUnknownSections(const YAML::Node& rig, const std::string& source) {
  for (const auto& entry : rig) {
    const auto name = entry.first.as<std::string>();
    bool known = false;
    std::string names;
    for (const char* section :
         {rig_sections::kCameras, rig_sections::kImu, rig_sections::kLaser, rig_sections::kRangeFinders,
          rig_sections::kMounting, rig_sections::kDisparity, rig_sections::kDrive,
          rig_sections::kWheelOdometry, rig_sections::kUncertainty, rig_sections::kBase}) {
      known = known || name == section;
      names += (names.empty() ? "" : " | ") + std::string(section);
    }
    if (!known) throw ParameterError(source + ": unknown section " + name + "; a rig has: " + names);
  }
}

/// Position in the file at which a node's text begins.
std::size_t positionOf(const std::string& text, const YAML::Mark& mark) {
  std::size_t line_start = 0;
  for (int line = 0; line < mark.line; ++line) line_start = text.find('\n', line_start) + 1;
  return line_start + static_cast<std::size_t>(mark.column);
}

/// The first `count` names.
std::string joined(const std::vector<std::string>& path, std::size_t count) {
  return fmt::format("{}", fmt::join(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(count), "/"));
}

std::string toText(double angle_deg) {
  const std::string text = fmt::format("{:.2f}", angle_deg);
  return text == "-0.00" ? "0.00" : text;
}

}  // namespace

void SensorMounting::describe(ParameterVisitor& visitor) {
  const Range<double> near{-100.0, 100.0};
  const Range<double> turn{-360.0, 360.0};
  visitor.real("x_m", x_m, near, "m", "forward of base_link's origin");
  visitor.real("y_m", y_m, near, "m", "to the left of base_link's origin");
  visitor.real("z_m", z_m, near, "m", "above base_link's origin");
  visitor.real("roll_deg", roll_deg, turn, "deg", "about base_link's x axis, applied first");
  visitor.real("pitch_deg", pitch_deg, turn, "deg",
               "about base_link's y axis, applied second; positive looks down");
  visitor.real("yaw_deg", yaw_deg, turn, "deg",
               "about base_link's z axis, applied last; positive turns left");
}

Eigen::Isometry3d SensorMounting::T_base_sensor() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << x_m, y_m, z_m;
  T.linear() = RollPitchYaw::fromDegrees(roll_deg, pitch_deg, yaw_deg).rotation();
  return T;
}

Eigen::Isometry3d SensorMounting::T_base_optical() const {
  Eigen::Isometry3d T = T_base_sensor();
  T.linear() = T.linear() * opticalToBody();
  return T;
}

void SensorMounting::setRotation(const Eigen::Matrix3d& R_base_sensor) {
  const RollPitchYaw angles = RollPitchYaw::of(R_base_sensor);
  roll_deg = angles.roll * kDegPerRad;
  pitch_deg = angles.pitch * kDegPerRad;
  yaw_deg = angles.yaw * kDegPerRad;
}

void Mounting::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "camera", camera);
  visitSection(visitor, "imu", imu);
  visitSection(visitor, "laser", laser);
}

RigFile::RigFile(std::string text, std::string source)
    : text_(std::move(text)), source_(std::move(source)), root_(parseYaml(text_, source_)) {
  if (!root_.IsMap()) {
    throw ParameterError(source_ + ": a rig file holds sections, e.g. `mounting:`; this one holds none");
  }
  refuseUnknownSections(root_, source_);
}

RigFile RigFile::load(const std::string& path) {
  return {readTextFile(path), path};
}

RigFile RigFile::parse(const std::string& text, const std::string& source) {
  return {text, source};
}

YAML::Node RigFile::section(const std::string& name) const {
  const YAML::Node found = root_[name];
  return found.IsDefined() ? found : YAML::Node();
}

std::string RigFile::sectionName(const std::string& name) const {
  return source_ + ": " + name;
}

Mounting RigFile::mounting() const {
  Mounting mounting;
  readParameters(section(rig_sections::kMounting), sectionName(rig_sections::kMounting), mounting);
  return mounting;
}

/// Returns `mounting/sensor/name` of the file, which must be a number.
YAML::Node RigFile::numberNode(const std::string& sensor, const std::string& name) const {
  const std::string full_name = "mounting/" + sensor + "/" + name;
  const std::string expected =
      "; expected is a rig file with `mounting: {" + sensor +
      ": {x_m: 0.0, y_m: 0.0, z_m: 0.0, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0.0}}`";
  const YAML::Node mounting = section(rig_sections::kMounting);
  const YAML::Node pose = mounting.IsMap() ? mounting[sensor] : YAML::Node();
  const YAML::Node node = pose && pose.IsMap() ? pose[name] : YAML::Node();
  if (!node || !node.IsScalar()) throw ParameterError(source_ + ": " + full_name + " is missing" + expected);
  double value = 0.0;
  if (!YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    throw ParameterError(source_ + ": " + full_name + " is '" + node.Scalar() + "', no number" + expected);
  }
  return node;
}

void RigFile::requireRotation(const std::string& sensor) const {
  for (const char* angle : kAngles) numberNode(sensor, angle);
}

void RigFile::setRotation(const std::string& sensor, const Eigen::Matrix3d& R_base_sensor) {
  SensorMounting mounting;
  mounting.setRotation(R_base_sensor);
  requireRotation(sensor);
  const std::string angles[] = {toText(mounting.roll_deg), toText(mounting.pitch_deg),
                                toText(mounting.yaw_deg)};
  for (std::size_t i = 0; i < kAngles.size(); ++i)
    replaceNumber(numberNode(sensor, kAngles[i]), "mounting/" + sensor + "/" + kAngles[i], angles[i]);
}

void RigFile::setNumber(const std::vector<std::string>& path, const std::string& value) {
  const std::string name = joined(path, path.size());
  YAML::Node node = section(path.front());
  if (node.IsNull() && path.size() == 2) {
    const bool ends_a_line = text_.empty() || text_.back() == '\n';
    edit(text_.size(), 0, (ends_a_line ? "" : "\n") + path[0] + ":\n  " + path[1] + ": " + value + "\n");
    return;
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool last = i + 1 == path.size();
    const YAML::Node child =
        node.IsMap() ? std::as_const(node)[path[i]] : YAML::Node(YAML::NodeType::Undefined);
    if (!child.IsDefined() && (!last || !node.IsMap() || node.size() == 0)) {
      throw ParameterError(source_ + ": " + name + " cannot be set: " + joined(path, last ? i : i + 1) +
                           " is missing or empty; write that part of the file first");
    }
    if (!child.IsDefined()) {
      insert(node, path[i], value);
      return;
    }
    node.reset(child);
  }
  replaceNumber(node, name, value);
}

/// Before the first line, or the first entry, of a map.
void RigFile::insert(const YAML::Node& map, const std::string& name, const std::string& value) {
  const YAML::Mark first = map.begin()->first.Mark();
  const std::string between = map.Style() == YAML::EmitterStyle::Flow
                                  ? ", "
                                  : "\n" + std::string(static_cast<std::size_t>(first.column), ' ');
  edit(positionOf(text_, first), 0, name + ": " + value + between);
}

void RigFile::replaceNumber(const YAML::Node& node, const std::string& full_name, const std::string& value) {
  const std::size_t position = positionOf(text_, node.Mark());
  if (!node.IsScalar() || text_.compare(position, node.Scalar().size(), node.Scalar()) != 0) {
    throw ParameterError(source_ + ": " + full_name +
                         " must be a plain number, without quotes, tags or anchors, to be replaced");
  }
  edit(position, node.Scalar().size(), value);
}

void RigFile::edit(std::size_t position, std::size_t length, const std::string& text) {
  text_.replace(position, length, text);
  root_.reset(parseYaml(text_, source_));  // assignment would change the nodes of copies of this object, too
}

}  // namespace stereo_nav
