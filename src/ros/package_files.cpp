#include "ros/package_files.h"

#include <ros/package.h>

#include <filesystem>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {

std::string configFile(const std::string& name) {
  if (std::filesystem::is_regular_file(name)) return name;
  const std::string package = ros::package::getPath("stereo_nav");
  if (package.empty()) {
    throw InputError("no file " + name +
                     ", and the package stereo_nav is not on the ROS package path; source its setup.bash");
  }
  std::string in_package = package + "/config/" + name;
  if (std::filesystem::exists(in_package)) return in_package;
  throw InputError("no file " + name + ", neither here nor in " + package + "/config");
}

std::string scenarioFile(const std::string& name) {
  if (std::filesystem::is_regular_file(name)) return name;
  return configFile("scenarios/" + name + ".yaml");
}

std::string thesisCalibrationFolder() {
  return std::filesystem::path(configFile("thesis/left.yaml")).parent_path().string();
}

}  // namespace stereo_nav::ros_io
