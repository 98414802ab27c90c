#include "navigation/obstacles/floor_plane.h"

#include <array>
#include <cmath>

namespace stereo_nav::navigation {
namespace {

constexpr int kStep_px = 4;  // a sixteenth of all pixels is plenty for three numbers
constexpr int kFewest = 100;
constexpr double kGate_px = 0.8;  // about three deviations of a disparity
/// The expected floor counts as so many pixels: directions that the image does not show stay as expected.
constexpr double kPriorPixels = 20.0;

/// Least squares of the plane over the pixels within the gate around `floor`; returns how many there were.
int refit(const cv::Mat& disparity, double gate_px, const FloorPlane& expected, FloorPlane& floor) {
  const double u0 = disparity.cols / 2.0, v0 = disparity.rows / 2.0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int used = 0;
  for (int v = 0; v < disparity.rows; v += kStep_px) {
    const float* row = disparity.ptr<float>(v);
    for (int u = 0; u < disparity.cols; u += kStep_px) {
      const double d = row[u], d_floor = floor.disparity(u, v);
      if (d <= 0.0 || d_floor <= 1.0 || std::fabs(d - d_floor) > gate_px) continue;
      const Eigen::Vector3d x((u - u0) / u0, (v - v0) / v0, 1.0);
      normal += x * x.transpose();
      right += x * (d - expected.disparity(u, v));
      ++used;
    }
  }
  if (used < kFewest) return used;
  normal.diagonal().array() += kPriorPixels;
  const Eigen::Vector3d change = normal.ldlt().solve(right);
  floor.coefficients = expected.coefficients + Eigen::Vector3d(change.x() / u0, change.y() / v0,
                                                               change.z() - change.x() - change.y());
  return used;
}

/// Direction that is up in the camera's axes, from the plane: the gradient of disparity points down.
Eigen::Vector3d down(const FloorPlane& floor, const DisparityCamera& camera) {
  const Eigen::Vector3d& c = floor.coefficients;
  return Eigen::Vector3d(c.x() * camera.fx, c.y() * camera.fy, floor.disparity(camera.cx, camera.cy));
}

}  // namespace

FloorPlane floorOf(const DisparityCamera& camera) {
  const Eigen::Vector3d down_camera = -(camera.T_base_camera.linear().transpose() * Eigen::Vector3d::UnitZ());
  FloorPlane floor;
  floor.height_m = camera.T_base_camera.translation().z();
  const double scale = camera.fx * camera.baseline_m / floor.height_m;
  const Eigen::Vector3d per_pixel(down_camera.x() / camera.fx, down_camera.y() / camera.fy, 0.0);
  floor.coefficients = scale * per_pixel;
  floor.coefficients.z() = scale * (down_camera.z() - per_pixel.x() * camera.cx - per_pixel.y() * camera.cy);
  return floor;
}

FloorPlane estimatedFloor(const cv::Mat& disparity, const DisparityCamera& camera, const FloorPlane& expected,
                          double max_tilt_rad) {
  if (max_tilt_rad <= 0.0) return expected;
  FloorPlane floor = expected;
  // A tilt shifts the floor's disparity by the same number of pixels everywhere.
  const double shift_px = camera.fx * camera.baseline_m / expected.height_m * std::tan(max_tilt_rad);
  for (const double gate_px : {kGate_px + shift_px, 2.0 * kGate_px, kGate_px}) {
    if (refit(disparity, gate_px, expected, floor) < kFewest) return expected;
  }
  const Eigen::Vector3d now = down(floor, camera), before = down(expected, camera);
  const double tilt = std::atan2(now.cross(before).norm(), now.dot(before));
  const double scale = now.norm() / before.norm();  // the inverse of the camera's height
  if (tilt > max_tilt_rad || std::fabs(scale - 1.0) > 0.1) return expected;
  floor.height_m = expected.height_m / scale;
  return floor;
}

}  // namespace stereo_nav::navigation
