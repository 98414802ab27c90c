#include "tools/import_sequence/kitti_raw_files.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

constexpr double kEarthRadius_m = 6378137.0;

/// Order of the values in a file of oxts/data, as its dataformat.txt lists them.
enum OxtsColumn : std::size_t {
  kLatitude,
  kLongitude,
  kAltitude,
  kRoll,
  kPitch,
  kYaw,
  kAcceleration = 11,
  kRate = 17
};

ros::Time dateOf(const TextRow& row) {
  std::tm date{};
  double seconds = 0.0;
  const std::string text = row.fields[0] + " " + (row.fields.size() > 1 ? row.fields[1] : "");
  const int read = std::sscanf(text.c_str(), "%d-%d-%d %d:%d:%lf", &date.tm_year, &date.tm_mon, &date.tm_mday,
                               &date.tm_hour, &date.tm_min, &seconds);
  if (read != 6 || date.tm_year < 1971 || date.tm_year > 2100 || !(seconds >= 0.0 && seconds < 61.0)) {
    throw InputError(row.source + ": '" + text + "' is no date such as 2011-09-26 13:02:25.594360375");
  }
  date.tm_year -= 1900;
  date.tm_mon -= 1;
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(timegm(&date)) * 1000000000 +
                        static_cast<std::uint64_t>(std::llround(seconds * 1e9)));
}

Eigen::Isometry3d poseOf(const TextRow& row, double scale) {
  constexpr double kDegree = M_PI / 180.0;
  const double latitude = row.number(kLatitude) * kDegree;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << scale * kEarthRadius_m * row.number(kLongitude) * kDegree,
      scale * kEarthRadius_m * std::log(std::tan(M_PI / 4.0 + latitude / 2.0)), row.number(kAltitude);
  pose.linear() = (Eigen::AngleAxisd(row.number(kYaw), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(row.number(kPitch), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(row.number(kRoll), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

Eigen::Vector3d vectorOf(const TextRow& row, std::size_t first) {
  return {row.number(first), row.number(first + 1), row.number(first + 2)};
}

}  // namespace

std::vector<ros::Time> readDates(const std::string& path) {
  std::vector<ros::Time> stamps;
  for (const TextRow& row : readTextTable(path)) stamps.push_back(dateOf(row));
  if (stamps.empty()) throw InputError(path + ": holds no stamp; copy the drive again");
  return stamps;
}

std::vector<double> calibrationRow(const std::string& path, const std::string& name, std::size_t count) {
  for (const TextRow& row : readTextTable(path)) {
    if (row.fields[0] != name + ":") continue;
    std::vector<double> values;
    for (std::size_t i = 1; i <= count; ++i) values.push_back(row.number(i));
    return values;
  }
  throw InputError(path + ": has no line '" + name + ":' with " + std::to_string(count) +
                   " numbers; copy the calibration of the drive's day again");
}

Eigen::Isometry3d readMotion(const std::string& path) {
  const auto R = calibrationRow(path, "R", 9);
  const auto t = calibrationRow(path, "T", 3);
  const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
  if ((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() > 1e-3 ||
      rotation.determinant() < 0.0)
    throw InputError(path + ": R is no rotation matrix; copy the calibration again");
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  motion.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  return motion;
}

std::vector<OxtsReading> readOxts(const std::string& folder, std::size_t& left_out) {
  const auto stamps = readDates(folder + "/timestamps.txt");
  std::vector<OxtsReading> readings;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double scale = 0.0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof(name), "/data/%010zu.txt", i);
    const auto rows =
        std::filesystem::exists(folder + name) ? readTextTable(folder + name) : std::vector<TextRow>();
    if (rows.empty() || (!readings.empty() && stamps[i] <= readings.back().stamp)) {
      ++left_out;
      continue;
    }
    const TextRow& row = rows.front();
    if (readings.empty()) {
      scale = std::cos(row.number(kLatitude) * M_PI / 180.0);
      origin = poseOf(row, scale).translation();
    }
    OxtsReading reading{stamps[i], poseOf(row, scale), vectorOf(row, kRate), vectorOf(row, kAcceleration)};
    reading.T_world_imu.pretranslate(-origin);
    readings.push_back(reading);
  }
  if (readings.empty())
    throw InputError(folder + "/data: holds no reading; copy the drive again, or remove oxts");
  return readings;
}

}  // namespace stereo_nav::tools
