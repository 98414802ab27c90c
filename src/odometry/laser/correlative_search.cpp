#include "odometry/laser/correlative_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stereo_nav::odometry {
namespace {

constexpr double kReach_m = 15.0;  ///< of the points that are compared
constexpr double kLeastWindow_m = 0.3;
constexpr double kMostWindow_m = 1.0;
constexpr double kLeastWindow_rad = 0.15;
constexpr double kMostWindow_rad = 0.8;
constexpr std::size_t kMostPoints = 120;
/// A scan all on the map speaks like this many standard deviations squared of the prior.
constexpr double kWeight = 40.0;

/// The points of the map around a place: 2 in their cells, 1 in those beside.
class Raster {
 public:
  Raster(const LineMap& map, const Eigen::Vector2d& middle)
      : origin_(middle - Eigen::Vector2d::Constant(kReach_m + kMostWindow_m)),
        side_(static_cast<int>(2.0 * (kReach_m + kMostWindow_m) / kSearchStep_m) + 1),
        cells_(static_cast<std::size_t>(side_ * side_), 0) {
    for (const auto& scan : map.scans())
      for (const Eigen::Vector2d& p : scan) mark(p);
  }

  int at(const Eigen::Vector2d& p) const {
    const int ix = index(p.x() - origin_.x()), iy = index(p.y() - origin_.y());
    if (ix < 0 || iy < 0 || ix >= side_ || iy >= side_) return 0;
    return cells_[static_cast<std::size_t>(iy * side_ + ix)];
  }

 private:
  static int index(double value_m) { return static_cast<int>(std::floor(value_m / kSearchStep_m)); }

  void mark(const Eigen::Vector2d& p) {
    const int ix = index(p.x() - origin_.x()), iy = index(p.y() - origin_.y());
    if (ix < 1 || iy < 1 || ix + 1 >= side_ || iy + 1 >= side_) return;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        auto& cell = cells_[static_cast<std::size_t>((iy + dy) * side_ + ix + dx)];
        cell = std::max<std::uint8_t>(cell, dx == 0 && dy == 0 ? 2 : 1);
      }
    }
  }

  Eigen::Vector2d origin_;
  int side_;
  std::vector<std::uint8_t> cells_;
};

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> result;
  const std::size_t every = points.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += every)
    if (points[i].norm() < kReach_m) result.push_back(points[i]);
  return result;
}

/// Steps to either side that cover three standard deviations.
int stepsOf(double variance, double step, double least, double most) {
  return static_cast<int>(std::ceil(std::clamp(3.0 * std::sqrt(variance), least, most) / step));
}

}  // namespace

Eigen::Vector3d searchShift(const std::vector<Eigen::Vector2d>& points_base, const LineMap& map,
                            const PlanarState& prior, const Eigen::Matrix3d& prior_covariance) {
  const std::vector<Eigen::Vector2d> points = thinned(points_base);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  if (points.empty()) return best;
  const Raster raster(map, prior.p_odom);
  const Eigen::Matrix3d information =
      Eigen::Matrix3d(prior_covariance + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  const int nx = stepsOf(prior_covariance(0, 0), kSearchStep_m, kLeastWindow_m, kMostWindow_m);
  const int ny = stepsOf(prior_covariance(1, 1), kSearchStep_m, kLeastWindow_m, kMostWindow_m);
  const int nyaw = stepsOf(prior_covariance(2, 2), kSearchStep_rad, kLeastWindow_rad, kMostWindow_rad);
  const double weight = kWeight / (2.0 * static_cast<double>(points.size()));
  double best_score = -1e9;
  std::vector<Eigen::Vector2d> turned(points.size());
  for (int k = -nyaw; k <= nyaw; ++k) {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(prior.yaw_rad + k * kSearchStep_rad).toRotationMatrix();
    for (std::size_t i = 0; i < points.size(); ++i) turned[i] = prior.p_odom + R * points[i];
    for (int ix = -nx; ix <= nx; ++ix) {
      for (int iy = -ny; iy <= ny; ++iy) {
        const Eigen::Vector3d shift(ix * kSearchStep_m, iy * kSearchStep_m, k * kSearchStep_rad);
        int hits = 0;
        for (const Eigen::Vector2d& p : turned) hits += raster.at(p + shift.head<2>());
        const double score = weight * hits - 0.5 * std::min(9.0, shift.dot(information * shift));
        if (score <= best_score) continue;
        best_score = score;
        best = shift;
      }
    }
  }
  return best;
}

}  // namespace stereo_nav::odometry
