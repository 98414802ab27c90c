// Calibration files of Kalibr, OpenCV and ROS.
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ros/calibration_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/import_sequence/raw_pair.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;

std::vector<double> numbers(const std::string& source, const YAML::Node& node, const std::string& key,
                            std::size_t count) {
  std::vector<double> values;
  try {
    values = node.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    values.clear();
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (finite && values.size() == count) return values;
  throw InputError(source + ": " + key + " must be " + std::to_string(count) +
                   " finite numbers; is the file as the calibration program wrote it?");
}

RawLens readKalibrLens(const std::string& source, const YAML::Node& camera) {
  const auto camera_model = camera["camera_model"].as<std::string>("");
  const auto distortion = camera["distortion_model"].as<std::string>("");
  if (camera_model != "pinhole" || (distortion != "radtan" && distortion != "equidistant")) {
    throw InputError(source + ": the model '" + camera_model + "-" + distortion +
                     "' is not supported; calibrate with pinhole-radtan or pinhole-equi");
  }
  RawLens lens;
  lens.model = distortion == "radtan" ? LensModel::kPlumbBob : LensModel::kEquidistant;
  const auto f_c = numbers(source, camera["intrinsics"], "intrinsics", 4);
  lens.K = {f_c[0], 0, f_c[2], 0, f_c[1], f_c[3], 0, 0, 1};
  lens.D = numbers(source, camera["distortion_coeffs"], "distortion_coeffs", 4);
  return lens;
}

RawPair readKalibr(const std::string& path) {
  const YAML::Node file = loadYamlFile(path);
  if (!file["cam0"] || !file["cam1"]) throw InputError(path + ": needs cam0 (left) and cam1 (right)");
  RawPair pair;
  pair.source = path;
  pair.left = readKalibrLens(path + ": cam0", file["cam0"]);
  pair.right = readKalibrLens(path + ": cam1", file["cam1"]);
  const auto size = numbers(path + ": cam0", file["cam0"]["resolution"], "resolution", 2);
  pair.size = cv::Size(static_cast<int>(size[0]), static_cast<int>(size[1]));
  std::vector<double> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const YAML::Node matrix = file["cam1"]["T_cn_cnm1"];
    const auto row = numbers(path + ": cam1", matrix ? matrix[i] : YAML::Node(), "each row of T_cn_cnm1", 4);
    for (int column = 0; column < 3; ++column) pair.R_right_left(static_cast<int>(i), column) = row[column];
    pair.t_right_left[static_cast<int>(i)] = row[3];
  }
  return pair;
}

/// Matrix of an OpenCV file with `count` elements or, where that is 0, as many as it has.
std::vector<double> readMatrix(const YAML::Node& file, const std::string& path, const std::string& name,
                               std::size_t count) {
  std::vector<double> values;
  try {
    const YAML::Node matrix = file[name];
    values = matrix["data"].as<std::vector<double>>();
    if (matrix["rows"].as<double>() * matrix["cols"].as<double>() != static_cast<double>(values.size()))
      values.clear();
  } catch (const YAML::Exception&) {
    values.clear();
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (finite && !values.empty() && (count == 0 || values.size() == count)) return values;
  throw InputError(path + ": " + name + " is missing or has not the size that stereo_calib writes");
}

/// A file of cv::FileStorage. Its own reader is not for files that may be damaged: some end it by an
/// assertion, or never.
YAML::Node readOpenCvFile(const std::string& path) {
  std::ifstream file(path);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  // The first line, %YAML:1.0, is none of YAML's.
  if (text.compare(0, 5, "%YAML") == 0) text.erase(0, text.find('\n'));
  try {
    const YAML::Node node = YAML::Load(text);
    if (node.IsMap()) return node;
  } catch (const YAML::Exception&) {
    // said below
  }
  throw InputError(path + ": cannot be read as a file of OpenCV (%YAML:1.0)");
}

RawPair readOpenCv(const std::string& intrinsics_path, const std::string& extrinsics_path) {
  if (!fs::exists(extrinsics_path)) {
    throw InputError(extrinsics_path + ": does not exist; stereo_calib writes it beside " + intrinsics_path);
  }
  const YAML::Node intrinsics = readOpenCvFile(intrinsics_path);
  const YAML::Node extrinsics = readOpenCvFile(extrinsics_path);
  RawPair pair;
  pair.source = extrinsics_path;
  pair.left.K = cv::Matx33d(readMatrix(intrinsics, intrinsics_path, "M1", 9).data());
  pair.left.D = readMatrix(intrinsics, intrinsics_path, "D1", 0);
  pair.right.K = cv::Matx33d(readMatrix(intrinsics, intrinsics_path, "M2", 9).data());
  pair.right.D = readMatrix(intrinsics, intrinsics_path, "D2", 0);
  pair.R_right_left = cv::Matx33d(readMatrix(extrinsics, extrinsics_path, "R", 9).data());
  pair.t_right_left = cv::Vec3d(readMatrix(extrinsics, extrinsics_path, "T", 3).data());
  for (const RawLens* lens : {&pair.left, &pair.right}) {
    const std::size_t count = lens->D.size();
    if (count == 4 || count == 5 || count == 8 || count == 12 || count == 14) continue;
    throw InputError(intrinsics_path + ": a camera has " + std::to_string(count) +
                     " distortion coefficients; OpenCV's model has 4, 5, 8, 12 or 14");
  }
  return pair;
}

sensor_msgs::CameraInfo readCameraInfo(const std::string& path) {
  if (!fs::exists(path)) throw InputError(path + ": does not exist; the other camera's file is there");
  return ros_io::readCalibrationFile(path);
}

}  // namespace

void checkRawPair(const RawPair& pair) {
  const cv::Matx33d rest = pair.R_right_left.t() * pair.R_right_left - cv::Matx33d::eye();
  if (cv::norm(rest) > 1e-3 || cv::determinant(pair.R_right_left) < 0.0) {
    throw InputError(pair.source + ": the rotation between the cameras is no rotation matrix");
  }
  for (const RawLens* lens : {&pair.left, &pair.right}) {
    if (lens->K(0, 0) > 0.0 && lens->K(1, 1) > 0.0) continue;
    throw InputError(pair.source + ": a focal length is not above 0; calibrate the pair again");
  }
  // The left camera lies to the left of the right one, in the right one's axes.
  if (pair.t_right_left[0] < 0.0) return;
  throw InputError(pair.source +
                   ": the second camera does not lie to the right of the first one; are the two swapped?");
}

std::optional<RawPair> readRawPair(const std::string& folder) {
  std::optional<RawPair> pair;
  if (fs::exists(folder + "/intrinsics.yml")) {
    pair = readOpenCv(folder + "/intrinsics.yml", folder + "/extrinsics.yml");
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find("camchain") == std::string::npos || entry.path().extension() != ".yaml") continue;
    if (pair) throw InputError(folder + ": holds " + name + " and " + pair->source + "; leave one of them");
    try {
      pair = readKalibr(entry.path().string());
    } catch (const YAML::Exception& error) {
      throw InputError(entry.path().string() + ": is not as Kalibr writes it: " + error.what());
    }
  }
  if (pair) checkRawPair(*pair);
  return pair;
}

std::optional<RectifyingPair> readRosPair(const std::string& folder) {
  const std::string left = folder + "/left.yaml";
  const std::string right = folder + "/right.yaml";
  if (!fs::exists(left) && !fs::exists(right)) return std::nullopt;
  return RectifyingPair{left, readCameraInfo(left), readCameraInfo(right)};
}

}  // namespace stereo_nav::tools
