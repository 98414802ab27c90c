#include "support/textured_room.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace stereo_nav::test {
namespace {

constexpr double kHalfWidth_m = 2.0;
constexpr double kFloor_m = 0.6;    // below the origin
constexpr double kCeiling_m = 1.6;  // above it
constexpr double kBackWall_m = 6.0;
constexpr double kFrontWall_m = -2.0;

/// A well-mixed number in [0, 1) of a lattice point.
double lattice(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t octave) {
  std::uint64_t h = octave * 0x9E3779B97F4A7C15ULL;
  for (const std::int64_t c : {x, y, z}) {
    h ^= static_cast<std::uint64_t>(c) + 0x9E3779B97F4A7C15ULL + (h << 6) + (h >> 2);
    h *= 0xFF51AFD7ED558CCDULL;
    h ^= h >> 33;
  }
  return static_cast<double>(h >> 11) / 9007199254740992.0;
}

double noise(const Eigen::Vector3d& p, std::uint64_t octave) {
  const Eigen::Vector3d cell = p.array().floor();
  const Eigen::Vector3d f = p - cell;
  const auto x = static_cast<std::int64_t>(cell.x());
  const auto y = static_cast<std::int64_t>(cell.y());
  const auto z = static_cast<std::int64_t>(cell.z());
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = corner >> 1 & 1;
    const int k = corner >> 2;
    const double weight =
        (i != 0 ? f.x() : 1.0 - f.x()) * (j != 0 ? f.y() : 1.0 - f.y()) * (k != 0 ? f.z() : 1.0 - f.z());
    value += weight * lattice(x + i, y + j, z + k, octave);
  }
  return value;
}

}  // namespace

double TexturedRoom::distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d low(-kHalfWidth_m, -kCeiling_m, kFrontWall_m);
  const Eigen::Vector3d high(kHalfWidth_m, kFloor_m, kBackWall_m);
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0.0 ? high[axis] : low[axis];
    nearest = std::min(nearest, (wall - origin[axis]) / direction[axis]);
  }
  return nearest;
}

double TexturedRoom::greyLevel(const Eigen::Vector3d& p_room) const {
  double value = 0.0;
  double weight = 0.0;
  double cell_m = 0.5;
  for (std::uint64_t octave = 1; octave <= 4; ++octave, cell_m *= 0.45) {
    // An offset that is no multiple of a cell keeps the walls off the lattice planes.
    value += noise((p_room + Eigen::Vector3d::Constant(10.137)) / cell_m, octave);
    weight += 1.0;
  }
  return std::min(255.0, std::max(0.0, 127.5 + 420.0 * (value / weight - 0.5)));
}

cv::Mat TexturedRoom::render(const Eigen::Isometry3d& T_room_camera, double fx, double fy, double cx,
                             double cy, cv::Size size) const {
  cv::Mat image(size, CV_8UC1);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      double sum = 0.0;
      for (const double dy : {-0.25, 0.25}) {
        for (const double dx : {-0.25, 0.25}) {
          const Eigen::Vector3d ray((column + dx - cx) / fx, (row + dy - cy) / fy, 1.0);
          const Eigen::Vector3d direction = T_room_camera.linear() * ray;
          const Eigen::Vector3d origin = T_room_camera.translation();
          sum += greyLevel(origin + distance(origin, direction) * direction);
        }
      }
      image.at<unsigned char>(row, column) = static_cast<unsigned char>(std::lround(sum / 4.0));
    }
  }
  return image;
}

TexturedRoom::Pair TexturedRoom::renderPair(const Eigen::Isometry3d& T_room_left,
                                            const Eigen::Isometry3d& T_room_left_at_right_time,
                                            const vision::StereoCalibration& c) const {
  const cv::Size size(c.width, c.height);
  const Eigen::Isometry3d T_room_right =
      T_room_left_at_right_time * Eigen::Translation3d(c.baseline_m, 0.0, 0.0);
  return {render(T_room_left, c.fx, c.fy, c.cx, c.cy, size),
          render(T_room_right, c.fx, c.fy, c.right_cx, c.cy, size)};
}

cv::Mat TexturedRoom::disparity(const Eigen::Isometry3d& T_room_left,
                                const vision::StereoCalibration& c) const {
  cv::Mat map(c.height, c.width, CV_32FC1);
  for (int row = 0; row < c.height; ++row) {
    for (int column = 0; column < c.width; ++column) {
      // The ray has unit z in the camera frame, so the distance in its lengths is the depth.
      const Eigen::Vector3d ray((column - c.cx) / c.fx, (row - c.cy) / c.fy, 1.0);
      const double depth_m = distance(T_room_left.translation(), T_room_left.linear() * ray);
      map.at<float>(row, column) = static_cast<float>(c.fx * c.baseline_m / depth_m);
    }
  }
  return map;
}

vision::StereoCalibration roomCalibration() {
  vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = 280.0;
  calibration.cx = calibration.right_cx = 159.5;
  calibration.cy = 119.5;
  calibration.baseline_m = 0.12;
  calibration.width = 320;
  calibration.height = 240;
  return calibration;
}

Eigen::Isometry3d roomDrive(double time_s) {
  constexpr double kSpeed_m_s = 0.4;
  constexpr double kTurn_rad_s = 10.0 / 180.0 * 3.14159265358979323846;
  // A circle of radius v / w: forward is z, a positive turn about y (down) goes to the right.
  const double angle = kTurn_rad_s * time_s;
  const double radius_m = kSpeed_m_s / kTurn_rad_s;
  Eigen::Isometry3d T_room_left = Eigen::Isometry3d::Identity();
  T_room_left.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T_room_left.translation() << radius_m * (1.0 - std::cos(angle)), 0.0, radius_m * std::sin(angle);
  return T_room_left;
}

}  // namespace stereo_nav::test
