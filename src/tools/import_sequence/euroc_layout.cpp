#include <sensor_msgs/distortion_models.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/calib3d.hpp>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;
/// Stored row by row, as OpenCV stores its matrices.
using RowMajorMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// sensor.yaml of a camera: the raw image and where the camera sits.
struct RawCamera {
  cv::Size size;
  cv::Matx33d K;
  cv::Vec<double, 5> D;  ///< k1 k2 p1 p2 k3
  Eigen::Isometry3d T_body_camera;
};

std::vector<double> numbers(const std::string& path, const YAML::Node& node, const std::string& key,
                            std::size_t count) {
  const std::string expected = "; expected is '" + key + "' with " + std::to_string(count) + " numbers";
  std::vector<double> values;
  try {
    values = node.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    throw InputError(path + ": " + key + " is missing or no list of numbers" + expected);
  }
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (finite && values.size() == count) return values;
  throw InputError(path + ": " + key + " has " + std::to_string(values.size()) +
                   " values or one that is not finite" + expected);
}

Eigen::Isometry3d readBodyPose(const std::string& path, const YAML::Node& sensor) {
  const auto values = numbers(path, sensor["T_BS"] ? sensor["T_BS"]["data"] : YAML::Node(), "T_BS", 16);
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  if ((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 1e-3 || R.determinant() < 0.0) {
    throw InputError(path + ": T_BS holds no rotation matrix");
  }
  Eigen::Isometry3d T_body_sensor = Eigen::Isometry3d::Identity();
  T_body_sensor.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  T_body_sensor.translation() = matrix.topRightCorner<3, 1>();
  return T_body_sensor;
}

RawCamera readRawCamera(const std::string& folder) {
  const std::string path = folder + "/sensor.yaml";
  const YAML::Node sensor = loadYamlFile(path);
  const auto model = sensor["distortion_model"].as<std::string>("");
  if (model != "radial-tangential") {
    throw InputError(path + ": distortion_model is '" + model + "'; only radial-tangential is supported");
  }
  const auto size = numbers(path, sensor["resolution"], "resolution", 2);
  const auto f_c = numbers(path, sensor["intrinsics"], "intrinsics", 4);
  const auto d = numbers(path, sensor["distortion_coefficients"], "distortion_coefficients", 4);
  return {cv::Size(static_cast<int>(size[0]), static_cast<int>(size[1])),
          {f_c[0], 0, f_c[2], 0, f_c[1], f_c[3], 0, 0, 1},
          {d[0], d[1], d[2], d[3], 0},
          readBodyPose(path, sensor)};
}

struct Rectification {
  cv::Matx33d R_left;  ///< from the raw to the rectified left camera frame
  cv::Matx33d R_right;
  cv::Matx34d P_left;
  cv::Matx34d P_right;
};

Rectification rectify(const RawCamera& left, const RawCamera& right) {
  const Eigen::Isometry3d T_right_left = right.T_body_camera.inverse() * left.T_body_camera;
  cv::Matx33d R;
  RowMajorMatrix3d::Map(R.val) = T_right_left.linear();
  cv::Vec3d t;
  Eigen::Vector3d::Map(t.val) = T_right_left.translation();
  Rectification result;
  cv::Mat Q;
  cv::stereoRectify(left.K, left.D, right.K, right.D, left.size, R, t, result.R_left, result.R_right,
                    result.P_left, result.P_right, Q, cv::CALIB_ZERO_DISPARITY, 0.0, left.size);
  return result;
}

sensor_msgs::CameraInfo toCameraInfo(const RawCamera& camera, const cv::Matx33d& R, const cv::Matx34d& P) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.size.width);
  info.height = static_cast<std::uint32_t>(camera.size.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(camera.D.val, camera.D.val + 5);
  std::copy(camera.K.val, camera.K.val + 9, info.K.begin());
  std::copy(R.val, R.val + 9, info.R.begin());
  std::copy(P.val, P.val + 12, info.P.begin());
  return info;
}

ros::Time stampOf(const TextRow& row, const ros::Time& previous) {
  const long long nanoseconds = row.integer(0);
  constexpr long long kLatest_ns = 4294967294LL * 1000000000LL;  // ros::Time counts in 32 bits
  if (nanoseconds > kLatest_ns) {
    throw InputError(row.source + ": the stamp " + row.fields[0] + " is no date in nanoseconds before 2106");
  }
  ros::Time stamp;
  if (nanoseconds > 0) stamp.fromNSec(static_cast<std::uint64_t>(nanoseconds));
  if (stamp > previous) return stamp;
  throw InputError(row.source + ": the stamp " + row.fields[0] + " is not later than the one before");
}

CameraTrack readTrack(const std::string& folder) {
  CameraTrack camera;
  std::vector<std::string> paths;
  for (const auto& row : readTextTable(folder + "/data.csv")) {
    camera.stamps.push_back(stampOf(row, camera.stamps.empty() ? ros::Time() : camera.stamps.back()));
    if (row.fields.size() < 2) throw InputError(row.source + ": names no image file");
    paths.push_back(folder + "/data/" + row.fields[1]);
  }
  if (paths.empty()) throw InputError(folder + "/data.csv: lists no image");
  camera.frames = readImageFiles(std::move(paths));
  return camera;
}

/// Variance of one sample from the noise density, in units per sqrt(Hz).
double variance(const YAML::Node& sensor, const std::string& key) {
  const double density = sensor[key].as<double>(0.0);
  return density * density * sensor["rate_hz"].as<double>(0.0);
}

ImuTrack readImu(const std::string& folder) {
  const std::string data_path = folder + "/data.csv";
  const auto rows = fs::exists(data_path) ? readTextTable(data_path) : std::vector<TextRow>();
  if (rows.empty()) {
    throw InputError(folder +
                     ": holds no IMU data (data.csv is missing or empty); copy the folder again, or import "
                     "without the IMU: --no-imu");
  }
  const std::string sensor_path = folder + "/sensor.yaml";
  const YAML::Node sensor = loadYamlFile(sensor_path);
  const Eigen::Matrix3d R_body_imu = readBodyPose(sensor_path, sensor).linear();
  ImuTrack imu;
  imu.angular_velocity_variance = variance(sensor, "gyroscope_noise_density");
  imu.linear_acceleration_variance = variance(sensor, "accelerometer_noise_density");
  for (const auto& row : rows) {
    ImuReading reading;
    reading.stamp = stampOf(row, imu.readings.empty() ? ros::Time() : imu.readings.back().stamp);
    reading.angular_velocity = R_body_imu * Eigen::Vector3d(row.number(1), row.number(2), row.number(3));
    reading.linear_acceleration = R_body_imu * Eigen::Vector3d(row.number(4), row.number(5), row.number(6));
    imu.readings.push_back(reading);
  }
  return imu;
}

std::vector<CameraPose> readGroundTruth(const std::string& path, const Eigen::Isometry3d& T_body_camera) {
  std::vector<CameraPose> poses;
  for (const auto& row : readTextTable(path)) {
    CameraPose pose;
    pose.stamp = stampOf(row, poses.empty() ? ros::Time() : poses.back().stamp);
    const Eigen::Quaterniond q(row.number(4), row.number(5), row.number(6), row.number(7));
    if (std::abs(q.norm() - 1.0) > 0.01) {
      throw InputError(row.source + ": the quaternion has norm " + std::to_string(q.norm()) +
                       " instead of 1; the order is qw qx qy qz");
    }
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    T_world_body.linear() = q.normalized().toRotationMatrix();
    T_world_body.translation() << row.number(1), row.number(2), row.number(3);
    pose.T_world_camera = T_world_body * T_body_camera;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace

Sequence readEuroc(const std::string& given_folder, bool with_imu) {
  const bool below_mav0 = fs::exists(given_folder + "/mav0/cam0");
  const std::string folder = below_mav0 ? given_folder + "/mav0" : given_folder;
  for (const char* camera : {"/cam0", "/cam1"}) {
    if (fs::is_directory(folder + camera)) continue;
    throw InputError(folder + camera + ": does not exist; the EuRoC layout has the folders cam0 and cam1");
  }
  Sequence sequence;
  sequence.left = readTrack(folder + "/cam0");
  sequence.right = readTrack(folder + "/cam1");
  const RawCamera left = readRawCamera(folder + "/cam0");
  const RawCamera right = readRawCamera(folder + "/cam1");
  if (left.size != right.size) {
    throw InputError(folder + ": cam0 and cam1 differ in their resolution; a stereo pair has one");
  }
  const Rectification rectification = rectify(left, right);
  sequence.left.info = toCameraInfo(left, rectification.R_left, rectification.P_left);
  sequence.right.info = toCameraInfo(right, rectification.R_right, rectification.P_right);
  if (!(sequence.right.info.P[3] < 0.0)) {
    throw InputError(folder + ": cam1 does not lie to the right of cam0; are the two swapped?");
  }
  const Eigen::Matrix3d R_rectified_raw = RowMajorMatrix3d::Map(rectification.R_left.val);
  sequence.T_body_camera = left.T_body_camera * Eigen::Isometry3d(R_rectified_raw.transpose());

  const std::string truth = folder + "/state_groundtruth_estimate0/data.csv";
  if (fs::exists(truth)) {
    sequence.ground_truth = readGroundTruth(truth, *sequence.T_body_camera);
  } else {
    sequence.notes.push_back("no state_groundtruth_estimate0: the recording has no ground truth");
  }
  if (!with_imu) return sequence;
  if (fs::exists(folder + "/imu0")) {
    sequence.imu = readImu(folder + "/imu0");
  } else {
    sequence.notes.push_back("no imu0: the recording has no IMU");
  }
  return sequence;
}

}  // namespace stereo_nav::tools
