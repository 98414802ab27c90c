#include "ros/calibration_file.h"

#include <camera_calibration_parsers/parse.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

void checkCameraModel(const std::string& path, const std::string& distortion_model) {
  static const std::set<std::string> known = {"", "pinhole", "plumb_bob", "rational_polynomial"};
  YAML::Node file;
  try {
    file = YAML::LoadFile(path);
  } catch (const YAML::Exception&) {
    return;  // not YAML, but ROS's reader understands it
  }
  const YAML::Node entry = file.IsMap() ? file["camera_model"] : YAML::Node();
  const auto model = entry && entry.IsScalar() ? entry.as<std::string>() : std::string();
  const bool fits = known.count(model) != 0 || (model == "fisheye" && distortion_model == "equidistant");
  if (fits) return;
  throw InputError(
      path + ": camera_model '" + model + "' with distortion_model '" + distortion_model +
      "' is not supported; calibrate as a pinhole camera, or write distortion_model: equidistant "
      "where the coefficients are the four of OpenCV's fisheye model");
}

}  // namespace

sensor_msgs::CameraInfo readCalibrationFile(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist");
  std::string name;
  sensor_msgs::CameraInfo info;
  if (!camera_calibration_parsers::readCalibration(path, name, info)) {
    throw InputError(path +
                     ": cannot be read as a camera calibration; it must be as camera_calibration saves it");
  }
  checkCameraModel(path, info.distortion_model);
  return info;
}

}  // namespace stereo_nav::ros_io
