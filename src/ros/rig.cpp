#include "ros/rig.h"

#include <ros/package.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::ros_io {
namespace {

const std::array<std::string, 4> kSections = {rig_sections::kCameras, rig_sections::kImu,
                                              rig_sections::kMounting, rig_sections::kDisparity};

constexpr double kRadPerDeg = M_PI / 180.0;

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  const std::size_t at = text.find(name);
  return at == std::string::npos ? text : text.replace(at, name.size(), value);
}

/// As ROS itself finds it.
std::string rosHome() {
  if (const char* ros_home = std::getenv("ROS_HOME")) return ros_home;
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : "") + "/.ros";
}

void refuseUnknownSections(const YAML::Node& rig, const std::string& path) {
  for (const auto& entry : rig) {
    const auto name = entry.first.as<std::string>();
    bool known = false;
    std::string names;
    for (const auto& section : kSections) {
      known = known || name == section;
      names += (names.empty() ? "" : " | ") + section;
    }
    if (!known) throw ParameterError(path + ": unknown section " + name + "; a rig has: " + names);
  }
}

}  // namespace

void SensorMounting::describe(ParameterVisitor& visitor) {
  const Range<double> near{-100.0, 100.0};
  const Range<double> turn{-360.0, 360.0};
  visitor.real("x_m", x_m, near, "m", "forward of base_link's origin");
  visitor.real("y_m", y_m, near, "m", "to the left of it");
  visitor.real("z_m", z_m, near, "m", "above it");
  visitor.real("roll_deg", roll_deg, turn, "deg", "about base_link's x axis, applied first");
  visitor.real("pitch_deg", pitch_deg, turn, "deg", "about its y axis, then; positive looks down");
  visitor.real("yaw_deg", yaw_deg, turn, "deg", "about its z axis, last; positive turns left");
}

Eigen::Isometry3d SensorMounting::T_base_sensor() const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << x_m, y_m, z_m;
  T.linear() = (Eigen::AngleAxisd(yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch_deg * kRadPerDeg, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll_deg * kRadPerDeg, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

void Mounting::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "camera", camera);
  visitSection(visitor, "imu", imu);
}

Eigen::Isometry3d Mounting::T_base_optical() const {
  Eigen::Matrix3d R_body_optical;
  R_body_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T = camera.T_base_sensor();
  T.linear() = T.linear() * R_body_optical;
  return T;
}

YAML::Node loadRigSection(const std::string& path, const std::string& section) {
  const YAML::Node rig = loadYamlFile(path);
  if (!rig.IsMap())
    throw ParameterError(path + ": a rig file holds sections, e.g. `mounting:`; this one none");
  refuseUnknownSections(rig, path);
  const YAML::Node found = rig[section];
  return found.IsDefined() ? found : YAML::Node();
}

std::string rigSectionName(const std::string& path, const std::string& section) {
  return path + ": " + section;
}

Mounting loadMounting(const std::string& path) {
  Mounting mounting;
  readParameters(loadRigSection(path, rig_sections::kMounting), rigSectionName(path, rig_sections::kMounting),
                 mounting);
  return mounting;
}

std::string pathOfUrl(const std::string& named_url, const std::string& camera_name) {
  const std::string url = replaced(replaced(named_url, "${ROS_HOME}", rosHome()), "${NAME}", camera_name);
  const std::string file = "file://", package = "package://";
  if (startsWith(url, file)) return url.substr(file.size());
  if (!startsWith(url, package)) {
    if (url.find("://") == std::string::npos) return url;
    throw ParameterError(url + ": neither file:///PATH nor package://PACKAGE/PATH");
  }
  const std::string rest = url.substr(package.size());
  const std::size_t slash = rest.find('/');
  const std::string name = rest.substr(0, slash);
  const std::string folder = ros::package::getPath(name);
  if (folder.empty() || slash == std::string::npos) {
    throw ParameterError(url + ": no package " + name + " on the ROS package path; source its setup.bash");
  }
  return folder + rest.substr(slash);
}

}  // namespace stereo_nav::ros_io
