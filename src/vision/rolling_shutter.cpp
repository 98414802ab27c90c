#include "vision/rolling_shutter.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::vision {
namespace {

/// Displacement of the homogeneous point (x, y, z, w) that moves with the twist for `time_s`, to second
/// order: rows are milliseconds apart.
Eigen::Vector3d displacement(const Vector6d& twist, double time_s, const Eigen::Vector3d& p, double w) {
  const Eigen::Vector3d turn = time_s * twist.tail<3>();
  const Eigen::Vector3d straight = w * time_s * twist.head<3>() + turn.cross(p);
  return straight + 0.5 * turn.cross(straight);
}

}  // namespace

double RollingShutter::time_s(const cv::Mat& raw_rows, const Eigen::Vector2d& px) const {
  if (isGlobal()) return 0.0;
  double row = std::clamp(px.y(), 0.0, calibration_.height - 1.0);
  if (!raw_rows.empty()) {
    const int u = std::clamp(static_cast<int>(std::lround(px.x())), 0, raw_rows.cols - 1);
    const int v = std::clamp(static_cast<int>(std::lround(px.y())), 0, raw_rows.rows - 1);
    row = raw_rows.at<float>(v, u);
  }
  return readout_s_ * ((row + 0.5) / calibration_.height - 0.5);
}

Eigen::Vector2d RollingShutter::seenLeft(const Eigen::Vector2d& px, const Eigen::Vector3d& p_camera,
                                         const Vector6d& twist) const {
  if (isGlobal()) return px;
  const Eigen::Vector3d p = p_camera + displacement(twist, leftTime_s(px), p_camera, 1.0);
  if (p.z() < kNearestDepth_m || p_camera.z() < kNearestDepth_m) return px;
  return px + projectLeft(calibration_, p) - projectLeft(calibration_, p_camera);
}

StereoObservation RollingShutter::atStamp(const StereoObservation& seen, const Eigen::Vector3d& p_camera,
                                          const Eigen::Isometry3d& T_late_camera,
                                          const Vector6d& twist) const {
  if (isGlobal()) return seen;
  StereoObservation straight = seen;
  const Eigen::Vector3d p_row = p_camera + displacement(twist, leftTime_s(seen.left_px), p_camera, 1.0);
  if (p_camera.z() < kNearestDepth_m || p_row.z() < kNearestDepth_m) return seen;
  straight.left_px -= projectLeft(calibration_, p_row) - projectLeft(calibration_, p_camera);
  if (!seen.has_right) return straight;
  const Eigen::Vector3d p_late = T_late_camera * p_camera;
  const Eigen::Vector3d p_late_row = p_late + displacement(twist, rightTime_s(seen.right_px), p_late, 1.0);
  if (p_late.z() < kNearestDepth_m || p_late_row.z() < kNearestDepth_m) return seen;
  straight.right_px -= projectRight(calibration_, p_late_row) - projectRight(calibration_, p_late);
  return straight;
}

Eigen::Vector3d RollingShutter::rayDepthAtStamp(const Eigen::Vector2d& left_px, double inverse_depth,
                                                const Vector6d& twist) const {
  const Eigen::Vector3d ray = leftRay(calibration_, left_px);
  if (isGlobal()) return {ray.x(), ray.y(), inverse_depth};
  const Eigen::Vector3d at_stamp = ray + displacement(twist, -leftTime_s(left_px), ray, inverse_depth);
  if (at_stamp.z() < kNearestDepth_m) return {ray.x(), ray.y(), inverse_depth};
  return {at_stamp.x() / at_stamp.z(), at_stamp.y() / at_stamp.z(), inverse_depth / at_stamp.z()};
}

}  // namespace stereo_nav::vision
