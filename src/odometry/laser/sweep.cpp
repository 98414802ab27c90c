#include "odometry/laser/sweep.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::odometry {

void Sweep::undistort(const LaserPoints& scan, const Eigen::Vector3d& correction,
                      std::vector<Eigen::Vector2d>& p_base) const {
  p_base.resize(scan.points.size());
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // of the piece, in the base at the first beam
  double start_yaw_rad = 0.0, start_s = 0.0;
  std::size_t i = 0;
  for (std::size_t k = 0; k < motion_.pieces.size() && i < scan.points.size(); ++k) {
    const RatePiece& piece = motion_.pieces[k];
    const Eigen::Vector3d rate = filter_.corrected(motion_, piece, correction).rate;
    const Eigen::Vector2d velocity =
        Eigen::Rotation2Dd(start_yaw_rad + 0.5 * piece.duration_s * rate.z()) * rate.head<2>();
    const bool last = k + 1 == motion_.pieces.size();
    for (; i < scan.points.size() && (last || scan.points[i].after_s <= start_s + piece.duration_s); ++i) {
      const double dt = scan.points[i].after_s - start_s;
      p_base[i] =
          start + dt * velocity + Eigen::Rotation2Dd(start_yaw_rad + dt * rate.z()) * scan.points[i].p_base;
    }
    start += piece.duration_s * velocity;
    start_yaw_rad += piece.duration_s * rate.z();
    start_s += piece.duration_s;
  }
  for (; i < scan.points.size(); ++i) p_base[i] = scan.points[i].p_base;
}

Eigen::Vector3d Sweep::gain() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const RatePiece& piece : motion_.pieces)
    sum += filter_.corrected(motion_, piece, Eigen::Vector3d::Zero()).gain;
  return motion_.pieces.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(motion_.pieces.size()));
}

}  // namespace stereo_nav::odometry
