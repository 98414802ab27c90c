#include "ros/calibration_url.h"

#include <ros/package.h>

#include <cstdlib>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {
namespace {

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  const std::size_t at = text.find(name);
  return at == std::string::npos ? text : text.replace(at, name.size(), value);
}

/// ROS_HOME, found as ROS itself does.
std::string rosHome() {
  if (const char* ros_home = std::getenv("ROS_HOME")) return ros_home;
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : "") + "/.ros";
}

}  // namespace

std::string pathOfUrl(const std::string& named_url, const std::string& camera_name) {
  std::string url = replaced(replaced(named_url, "${ROS_HOME}", rosHome()), "${NAME}", camera_name);
  const std::string file = "file://", package = "package://";
  if (startsWith(url, file)) return url.substr(file.size());
  if (!startsWith(url, package)) {
    if (url.find("://") == std::string::npos) return url;
    throw ParameterError(
        url + ": the calibration URL must be file:///PATH, package://PACKAGE/PATH or a plain path");
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
