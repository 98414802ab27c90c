#include "odometry/laser/correlative_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

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
/// The coarse raster's cells are three wide, the best of them are looked into.
constexpr int kCoarse = 3;
constexpr std::size_t kMostCoarse = 80;
/// Shifts that are nearer to each other lead to the same solution.
constexpr double kApart_m = 0.15;
constexpr double kApart_rad = 0.06;

/// The points of the map around a place: 2 in their cells, 1 in those beside; or in a coarse cell the most
/// that any shift by less than such a cell finds.
class Raster {
 public:
  Raster(const LineMap& map, const Eigen::Vector2d& middle)
      : origin_(middle - Eigen::Vector2d::Constant(kReach_m + kMostWindow_m)),
        side_(static_cast<int>(2.0 * (kReach_m + kMostWindow_m) / kSearchStep_m) + 1),
        fine_(static_cast<std::size_t>(side_ * side_), 0),
        coarse_(fine_.size(), 0) {
    for (const auto& scan : map.scans())
      for (const Eigen::Vector2d& p : scan) mark(p);
  }

  int fine(const Eigen::Vector2d& p) const { return at(fine_, p); }
  int coarse(const Eigen::Vector2d& p) const { return at(coarse_, p); }

 private:
  static int index(double value_m) { return static_cast<int>(std::floor(value_m / kSearchStep_m)); }

  int at(const std::vector<std::uint8_t>& cells, const Eigen::Vector2d& p) const {
    const int ix = index(p.x() - origin_.x()), iy = index(p.y() - origin_.y());
    if (ix < 0 || iy < 0 || ix >= side_ || iy >= side_) return 0;
    return cells[static_cast<std::size_t>(iy * side_ + ix)];
  }

  void mark(const Eigen::Vector2d& p) {
    const int ix = index(p.x() - origin_.x()), iy = index(p.y() - origin_.y());
    if (ix < 2 || iy < 2 || ix + 2 >= side_ || iy + 2 >= side_) return;
    if (fine_[static_cast<std::size_t>(iy * side_ + ix)] == 2) return;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const auto i = static_cast<std::size_t>((iy + dy) * side_ + ix + dx);
        const int apart = std::max(std::abs(dx), std::abs(dy));
        fine_[i] = std::max<std::uint8_t>(fine_[i], apart == 0 ? 2 : apart == 1 ? 1 : 0);
        coarse_[i] = std::max<std::uint8_t>(coarse_[i], apart <= 1 ? 2 : 1);
      }
    }
  }

  Eigen::Vector2d origin_;
  int side_;
  std::vector<std::uint8_t> fine_, coarse_;
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

struct ScoredShift {
  double score;
  int ix, iy, iyaw;  ///< steps

  Eigen::Vector3d shift() const { return {ix * kSearchStep_m, iy * kSearchStep_m, iyaw * kSearchStep_rad}; }
};

bool isBetter(const ScoredShift& a, const ScoredShift& b) {
  return a.score > b.score;
}

class ShiftSearch {
 public:
  ShiftSearch(const std::vector<Eigen::Vector2d>& points_base, const LineMap& map, const PlanarState& prior,
              const Eigen::Matrix3d& prior_covariance)
      : points_(thinned(points_base)),
        raster_(map, prior.p_odom),
        information_((prior_covariance + 1e-6 * Eigen::Matrix3d::Identity()).inverse()),
        nx_(stepsOf(prior_covariance(0, 0), kSearchStep_m, kLeastWindow_m, kMostWindow_m)),
        ny_(stepsOf(prior_covariance(1, 1), kSearchStep_m, kLeastWindow_m, kMostWindow_m)),
        nyaw_(stepsOf(prior_covariance(2, 2), kSearchStep_rad, kLeastWindow_rad, kMostWindow_rad)) {
    for (int k = -nyaw_; k <= nyaw_; ++k) {
      const Eigen::Matrix2d R = Eigen::Rotation2Dd(prior.yaw_rad + k * kSearchStep_rad).toRotationMatrix();
      std::vector<Eigen::Vector2d> turned;
      for (const Eigen::Vector2d& p : points_) turned.push_back(prior.p_odom + R * p);
      turned_.push_back(std::move(turned));
    }
  }

  std::vector<Eigen::Vector3d> best() const {
    if (points_.empty()) return {};
    std::vector<ScoredShift> shifts;
    for (const ScoredShift& block : bestBlocks())
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          shifts.push_back(scored({0.0, block.ix + dx, block.iy + dy, block.iyaw}, &Raster::fine));
    std::stable_sort(shifts.begin(), shifts.end(), isBetter);
    std::vector<Eigen::Vector3d> chosen;
    for (const ScoredShift& candidate : shifts) {
      const Eigen::Vector3d shift = candidate.shift();
      const auto beside = [&shift](const Eigen::Vector3d& better) {
        const Eigen::Vector3d apart = better - shift;
        return apart.head<2>().norm() < kApart_m && std::abs(apart.z()) < kApart_rad;
      };
      if (std::any_of(chosen.begin(), chosen.end(), beside)) continue;
      chosen.push_back(shift);
      if (chosen.size() == kSearchResults) break;
    }
    return chosen;
  }

 private:
  ScoredShift scored(ScoredShift candidate, int (Raster::*hits)(const Eigen::Vector2d&) const) const {
    const Eigen::Vector3d shift = candidate.shift();
    int sum = 0;
    for (const Eigen::Vector2d& p : turned_[static_cast<std::size_t>(candidate.iyaw + nyaw_)])
      sum += (raster_.*hits)(p + shift.head<2>());
    candidate.score =
        searchScore(sum / (2.0 * static_cast<double>(points_.size())), shift.dot(information_ * shift));
    return candidate;
  }

  std::vector<ScoredShift> bestBlocks() const {
    std::vector<ScoredShift> blocks;
    for (int k = -nyaw_; k <= nyaw_; ++k)
      for (int ix = -nx_; ix <= nx_ + 1; ix += kCoarse)
        for (int iy = -ny_; iy <= ny_ + 1; iy += kCoarse)
          blocks.push_back(scored({0.0, ix, iy, k}, &Raster::coarse));
    std::stable_sort(blocks.begin(), blocks.end(), isBetter);
    if (blocks.size() > kMostCoarse) blocks.resize(kMostCoarse);
    return blocks;
  }

  std::vector<Eigen::Vector2d> points_;
  std::vector<std::vector<Eigen::Vector2d>> turned_;  ///< for each rotation, at the prior's position
  Raster raster_;
  Eigen::Matrix3d information_;
  int nx_, ny_, nyaw_;
};

}  // namespace

double searchScore(double share, double squared_shift) {
  return kWeight * share - 0.5 * std::min(9.0, squared_shift);
}

std::vector<Eigen::Vector3d> searchShifts(const std::vector<Eigen::Vector2d>& points_base, const LineMap& map,
                                          const PlanarState& prior, const Eigen::Matrix3d& prior_covariance) {
  return ShiftSearch(points_base, map, prior, prior_covariance).best();
}

}  // namespace stereo_nav::odometry
