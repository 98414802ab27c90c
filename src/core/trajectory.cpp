#include "stereo_nav/core/trajectory.h"

#include <fmt/format.h>

#include <cmath>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav {
namespace {

std::vector<TextRow> readRows(const std::string& path, std::size_t columns, const std::string& meaning) {
  auto rows = readTextTable(path);
  if (rows.empty()) throw InputError(path + ": holds no line of data; expected " + meaning);
  for (const auto& row : rows) {
    if (row.fields.size() != columns) {
      throw InputError(row.source + ": " + std::to_string(row.fields.size()) + " columns instead of " +
                       std::to_string(columns) + "; expected " + meaning);
    }
  }
  return rows;
}

void checkIncreasing(const TextRow& row, double previous_s, double time_s) {
  if (time_s > previous_s) return;
  throw InputError(row.source + ": the stamp " + row.fields[0] +
                   " is not later than the one before; sort the file and remove duplicates");
}

Eigen::Quaterniond rotationOfTumRow(const TextRow& row) {
  const Eigen::Quaterniond q(row.number(7), row.number(4), row.number(5), row.number(6));
  if (std::abs(q.norm() - 1.0) < 0.01) return q.normalized();
  throw InputError(row.source + ": the quaternion has norm " + std::to_string(q.norm()) +
                   " instead of 1; the order is qx qy qz qw");
}

Eigen::Isometry3d poseOfKittiRow(const TextRow& row) {
  Eigen::Matrix<double, 3, 4> matrix;
  for (Eigen::Index i = 0; i < 12; ++i) matrix(i / 4, i % 4) = row.number(static_cast<std::size_t>(i));
  const Eigen::Matrix3d R = matrix.leftCols<3>();
  const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  if (defect > 0.01 || R.determinant() < 0.0) {
    throw InputError(row.source + ": the left 3x3 part is not a rotation matrix");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  pose.translation() = matrix.col(3);
  return pose;
}

}  // namespace

Trajectory readTum(const std::string& path) {
  Trajectory trajectory;
  for (const auto& row : readRows(path, 8, "TUM poses: t tx ty tz qx qy qz qw")) {
    StampedPose pose;
    pose.time_s = row.number(0);
    if (!trajectory.empty()) checkIncreasing(row, trajectory.back().time_s, pose.time_s);
    pose.T_world_body.linear() = rotationOfTumRow(row).toRotationMatrix();
    pose.T_world_body.translation() << row.number(1), row.number(2), row.number(3);
    trajectory.push_back(pose);
  }
  return trajectory;
}

Trajectory readKitti(const std::string& path, const std::vector<double>& times_s) {
  const auto rows = readRows(path, 12, "KITTI poses: the upper three rows of the 4x4 matrix, row by row");
  if (rows.size() != times_s.size()) {
    throw InputError(path + ": holds " + std::to_string(rows.size()) + " poses for " +
                     std::to_string(times_s.size()) + " stamps; do the two files belong together?");
  }
  Trajectory trajectory;
  for (std::size_t i = 0; i < rows.size(); ++i) trajectory.push_back({times_s[i], poseOfKittiRow(rows[i])});
  return trajectory;
}

std::vector<double> readKittiTimes(const std::string& path) {
  std::vector<double> times_s;
  for (const auto& row : readRows(path, 1, "one stamp in seconds a line")) {
    const double time_s = row.number(0);
    if (!times_s.empty()) checkIncreasing(row, times_s.back(), time_s);
    times_s.push_back(time_s);
  }
  return times_s;
}

std::string toTum(const Trajectory& trajectory) {
  std::string text = "# timestamp[s] tx ty tz [m] qx qy qz qw\n";
  for (const auto& pose : trajectory) {
    Eigen::Quaterniond q(pose.T_world_body.linear());
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    const Eigen::Vector3d p = pose.T_world_body.translation();
    text += fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", pose.time_s, p.x(),
                        p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::string toKitti(const Trajectory& trajectory) {
  std::string text;
  for (const auto& pose : trajectory) {
    for (int i = 0; i < 12; ++i) {
      text += fmt::format("{}{:.9e}", i == 0 ? "" : " ", pose.T_world_body.matrix()(i / 4, i % 4));
    }
    text += '\n';
  }
  return text;
}

Trajectory ofOtherBody(const Trajectory& trajectory, const Eigen::Isometry3d& T_body_other) {
  Trajectory other = trajectory;
  for (auto& pose : other) pose.T_world_body = pose.T_world_body * T_body_other;
  return other;
}

double pathLength(const Trajectory& trajectory) {
  std::vector<Eigen::Vector3d> positions_m;
  for (const auto& pose : trajectory) positions_m.push_back(pose.T_world_body.translation());
  return pathLength(positions_m);
}

double pathLength(const std::vector<Eigen::Vector3d>& positions_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < positions_m.size(); ++i)
    length_m += (positions_m[i] - positions_m[i - 1]).norm();
  return length_m;
}

}  // namespace stereo_nav
