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

/// ROS's reader ends the process on a matrix whose numbers are not as many as its rows and columns say.
void checkMatrices(const std::string& path) {
  YAML::Node file;
  try {
    file = YAML::LoadFile(path);
  } catch (const YAML::Exception&) {
    return;  // not YAML: ROS's reader for the other format counts by itself
  }
  if (!file.IsMap()) return;
  struct Size {
    const char* name;
    long long rows, columns;  ///< 0: any
  };
  for (const auto& [name, needed_rows, needed_columns] :
       {Size{"camera_matrix", 3, 3}, Size{"distortion_coefficients", 0, 0},
        Size{"rectification_matrix", 3, 3}, Size{"projection_matrix", 3, 4}}) {
    const YAML::Node matrix = file[name];
    if (!matrix || !matrix.IsMap()) continue;
    const YAML::Node data = matrix["data"];
    const auto rows = matrix["rows"] ? matrix["rows"].as<long long>(-1) : -1;
    const auto columns = matrix["cols"] ? matrix["cols"].as<long long>(-1) : -1;
    const auto count = data ? static_cast<long long>(data.size()) : -1;
    constexpr long long kMost = 14;  // coefficients of rational_polynomial; the other matrices are smaller
    const bool fits =
        rows >= 0 && columns >= 0 && rows <= kMost && columns <= kMost && rows * columns == count;
    const bool sized = needed_rows == 0 || (rows == needed_rows && columns == needed_columns);
    if (fits && sized) continue;
    throw InputError(path + ": " + name +
                     " has not as many numbers as its rows and cols say; take the file as "
                     "camera_calibration saved it");
  }
}

}  // namespace

sensor_msgs::CameraInfo readCalibrationFile(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist");
  std::string name;
  sensor_msgs::CameraInfo info;
  checkMatrices(path);
  if (!camera_calibration_parsers::readCalibration(path, name, info)) {
    throw InputError(path +
                     ": cannot be read as a camera calibration; it must be as camera_calibration saves it");
  }
  checkCameraModel(path, info.distortion_model);
  return info;
}

}  // namespace stereo_nav::ros_io
