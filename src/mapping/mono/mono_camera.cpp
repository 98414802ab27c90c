#include "mapping/mono/mono_camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace stereo_nav::mapping {
namespace {

/// Nearer to the plane of the lens nothing is seen; in lengths of the point's own vector.
constexpr double kLeastForward = 0.05;
constexpr double kRim = 0.98;

}  // namespace

std::optional<ProjectedPoint> MonoCamera::project(const Eigen::Vector3d& p_camera) const {
  const double z = p_camera.z();
  if (!(z > kLeastForward * p_camera.norm())) return std::nullopt;
  const Eigen::Vector2d straight(fx * p_camera.x() / z, fy * p_camera.y() / z);
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << fx / z, 0.0, -straight.x() / z, 0.0, fy / z, -straight.y() / z;
  const double scale = 1.0 / std::sqrt(1.0 + 2.0 * k * straight.squaredNorm());
  const Eigen::Matrix2d by_straight =
      scale * Eigen::Matrix2d::Identity() - 2.0 * k * scale * scale * scale * straight * straight.transpose();
  return ProjectedPoint{Eigen::Vector2d(cx, cy) + scale * straight, by_straight * by_point};
}

Eigen::Vector3d MonoCamera::ray(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d bent = px - Eigen::Vector2d(cx, cy);
  const Eigen::Vector2d straight = bent / std::sqrt(1.0 - std::min(kRim, 2.0 * k * bent.squaredNorm()));
  return {straight.x() / fx, straight.y() / fy, 1.0};
}

Eigen::Matrix2d MonoCamera::rayByPixel(const Eigen::Vector2d& px) const {
  const auto projected = project(ray(px));
  return projected->by_point.leftCols<2>().inverse();
}

bool MonoCamera::sees(const Eigen::Vector2d& px, double margin_px) const {
  return px.x() >= margin_px && px.y() >= margin_px && px.x() <= size.width - 1 - margin_px &&
         px.y() <= size.height - 1 - margin_px;
}

}  // namespace stereo_nav::mapping
