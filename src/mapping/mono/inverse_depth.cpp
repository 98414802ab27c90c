#include "mapping/mono/inverse_depth.h"

#include <cmath>
#include <limits>

namespace stereo_nav::mapping {

Eigen::Vector3d inverseDepthRay(double theta_rad, double phi_rad) {
  return {std::sin(theta_rad) * std::cos(phi_rad), -std::sin(phi_rad),
          std::cos(theta_rad) * std::cos(phi_rad)};
}

Eigen::Matrix<double, 3, 2> inverseDepthRayByAngles(double theta_rad, double phi_rad) {
  Eigen::Matrix<double, 3, 2> by_angles;
  by_angles << std::cos(theta_rad) * std::cos(phi_rad), -std::sin(theta_rad) * std::sin(phi_rad),  //
      0.0, -std::cos(phi_rad),                                                                     //
      -std::sin(theta_rad) * std::cos(phi_rad), -std::cos(theta_rad) * std::sin(phi_rad);
  return by_angles;
}

Eigen::Vector2d anglesOf(const Eigen::Vector3d& direction) {
  return {std::atan2(direction.x(), direction.z()),
          std::atan2(-direction.y(), std::hypot(direction.x(), direction.z()))};
}

Eigen::Matrix<double, 2, 3> anglesByDirection(const Eigen::Vector3d& direction) {
  const double level_2 = direction.x() * direction.x() + direction.z() * direction.z();
  const double level = std::sqrt(level_2);
  const double length_2 = direction.squaredNorm();
  Eigen::Matrix<double, 2, 3> by_direction;
  by_direction << direction.z() / level_2, 0.0, -direction.x() / level_2,  //
      direction.x() * direction.y() / (level * length_2), -level / length_2,
      direction.z() * direction.y() / (level * length_2);
  return by_direction;
}

Eigen::Vector3d pointOf(const Vector6d& inverse_depth) {
  return inverse_depth.head<3>() + inverseDepthRay(inverse_depth(3), inverse_depth(4)) / inverse_depth(5);
}

Eigen::Matrix<double, 3, 6> pointByInverseDepth(const Vector6d& inverse_depth) {
  const double rho = inverse_depth(5);
  Eigen::Matrix<double, 3, 6> by_landmark;
  by_landmark.leftCols<3>().setIdentity();
  by_landmark.middleCols<2>(3) = inverseDepthRayByAngles(inverse_depth(3), inverse_depth(4)) / rho;
  by_landmark.col(5) = -inverseDepthRay(inverse_depth(3), inverse_depth(4)) / (rho * rho);
  return by_landmark;
}

double linearityIndex(const Vector6d& inverse_depth, double rho_sigma,
                      const Eigen::Vector3d& p_camera_world) {
  const double rho = inverse_depth(5);
  if (rho <= 0.0) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d to_point = pointOf(inverse_depth) - p_camera_world;
  const double distance = to_point.norm();
  const double cosine = inverseDepthRay(inverse_depth(3), inverse_depth(4)).dot(to_point) / distance;
  const double depth_sigma = rho_sigma / (rho * rho);
  return 4.0 * depth_sigma / distance * std::abs(cosine);
}

}  // namespace stereo_nav::mapping
