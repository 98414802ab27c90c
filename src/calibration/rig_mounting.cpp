#include "calibration/rig_mounting.h"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace stereo_nav::calibration {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr const char* kAngles[] = {"roll_deg", "pitch_deg", "yaw_deg"};

YAML::Node parse(const std::string& rig_yaml, const std::string& source) {
  try {
    return YAML::Load(rig_yaml);
  } catch (const YAML::Exception& error) {
    throw RigFileError(source + ": no YAML file: " + error.what());
  }
}

/// mounting/`sensor`/`angle` of the file, which must be a plain number.
YAML::Node angleNode(const YAML::Node& rig, const std::string& source, const std::string& sensor,
                     const std::string& angle) {
  const std::string name = "mounting/" + sensor + "/" + angle;
  const std::string expected =
      "; expected is a rig file with `mounting: {" + sensor +
      ": {x_m: 0.0, y_m: 0.0, z_m: 0.0, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0.0}}`";
  const YAML::Node mounting = rig.IsMap() ? rig["mounting"] : YAML::Node();
  const YAML::Node pose = mounting && mounting.IsMap() ? mounting[sensor] : YAML::Node();
  const YAML::Node node = pose && pose.IsMap() ? pose[angle] : YAML::Node();
  if (!node || !node.IsScalar()) throw RigFileError(source + ": " + name + " is missing" + expected);
  double value = 0.0;
  if (!YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    throw RigFileError(source + ": " + name + " is '" + node.Scalar() + "', no number" + expected);
  }
  return node;
}

/// Where a node's text begins in the file.
std::size_t positionOf(const std::string& text, const YAML::Mark& mark) {
  std::size_t line_start = 0;
  for (int line = 0; line < mark.line; ++line) line_start = text.find('\n', line_start) + 1;
  return line_start + static_cast<std::size_t>(mark.column);
}

std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return std::string(text) == "-0.00" ? "0.00" : text;
}

}  // namespace

Eigen::Matrix3d RollPitchYaw::rotation() const {
  return (Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_deg * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_deg * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

RollPitchYaw RollPitchYaw::of(const Eigen::Matrix3d& R) {
  const double level = std::hypot(R(0, 0), R(1, 0));
  RollPitchYaw angles;
  angles.pitch_deg = std::atan2(-R(2, 0), level) / kDegree;
  constexpr double kGimbalLock = 1e-6;  // roll and yaw turn about one axis: all of it is called yaw
  if (level < kGimbalLock) {
    angles.yaw_deg = std::atan2(-R(0, 1), R(1, 1)) / kDegree;
  } else {
    angles.roll_deg = std::atan2(R(2, 1), R(2, 2)) / kDegree;
    angles.yaw_deg = std::atan2(R(1, 0), R(0, 0)) / kDegree;
  }
  return angles;
}

Eigen::Matrix3d opticalToBody() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R;
}

Eigen::Matrix3d readCameraRotation(const std::string& rig_yaml, const std::string& source) {
  const YAML::Node rig = parse(rig_yaml, source);
  RollPitchYaw angles;
  angles.roll_deg = angleNode(rig, source, "camera", kAngles[0]).as<double>();
  angles.pitch_deg = angleNode(rig, source, "camera", kAngles[1]).as<double>();
  angles.yaw_deg = angleNode(rig, source, "camera", kAngles[2]).as<double>();
  return angles.rotation() * opticalToBody();
}

std::string withImuRotation(const std::string& rig_yaml, const std::string& source,
                            const Eigen::Matrix3d& R_base_imu) {
  const YAML::Node rig = parse(rig_yaml, source);
  const RollPitchYaw angles = RollPitchYaw::of(R_base_imu);
  const double values[] = {angles.roll_deg, angles.pitch_deg, angles.yaw_deg};
  struct Edit {
    std::size_t position;
    std::size_t length;
    std::string text;
  };
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < 3; ++i) {
    const YAML::Node node = angleNode(rig, source, "imu", kAngles[i]);
    const std::size_t position = positionOf(rig_yaml, node.Mark());
    if (rig_yaml.compare(position, node.Scalar().size(), node.Scalar()) != 0) {
      throw RigFileError(source + ": mounting/imu/" + kAngles[i] +
                         " must be a plain number, without quotes, tags or anchors, to be replaced");
    }
    edits.push_back({position, node.Scalar().size(), degrees(values[i])});
  }
  // From the end, so that the earlier positions stay true.
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.position > b.position; });
  std::string text = rig_yaml;
  for (const Edit& edit : edits) text.replace(edit.position, edit.length, edit.text);
  return text;
}

}  // namespace stereo_nav::calibration
