#include "odometry/laser/correlative_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace stereo_nav::odometry {
namespace {

constexpr double kLeastWindow_m = 0.3;
constexpr double kMostWindow_m = 1.0;
constexpr double kLeastWindow_rad = 0.15;
constexpr double kMostWindow_rad = 0.8;
constexpr std::size_t kMostPoints = 120;
/// A scan all on the map speaks like this many standard deviations squared of the prior.
constexpr double kWeight = 40.0;
/// The coarse raster's cells are three wide, the best of them are looked into.
constexpr int kCoarse = 3;
static_assert(kMostWindow_m / kSearchStep_m + 2.0 <= SearchRaster::kMostShift);
constexpr std::size_t kMostCoarse = 80;
/// Shifts that are nearer to each other lead to the same solution.
constexpr double kApart_m = 0.15;
constexpr double kApart_rad = 0.06;

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> result;
  const std::size_t every = points.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < points.size(); i += every)
    if (points[i].norm() < SearchRaster::kReach_m) result.push_back(points[i]);
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

/// Of equal ones the one that stands first in the order of the search.
bool isBetterOrFirst(const ScoredShift& a, const ScoredShift& b) {
  return a.score != b.score ? isBetter(a, b) : std::tie(a.iyaw, a.ix, a.iy) < std::tie(b.iyaw, b.ix, b.iy);
}

class ShiftSearch {
 public:
  ShiftSearch(const std::vector<Eigen::Vector2d>& points_base, const SearchRaster& raster,
              const PlanarState& prior, const Eigen::Matrix3d& prior_covariance)
      : raster_(raster),
        information_((prior_covariance + 1e-6 * Eigen::Matrix3d::Identity()).inverse()),
        nx_(stepsOf(prior_covariance(0, 0), kSearchStep_m, kLeastWindow_m, kMostWindow_m)),
        ny_(stepsOf(prior_covariance(1, 1), kSearchStep_m, kLeastWindow_m, kMostWindow_m)),
        nyaw_(stepsOf(prior_covariance(2, 2), kSearchStep_rad, kLeastWindow_rad, kMostWindow_rad)) {
    const std::vector<Eigen::Vector2d> points = thinned(points_base);
    points_ = points.size();
    for (int k = -nyaw_; k <= nyaw_; ++k) {
      const Eigen::Matrix2d R = Eigen::Rotation2Dd(prior.yaw_rad + k * kSearchStep_rad).toRotationMatrix();
      for (const Eigen::Vector2d& p : points) places_.push_back(raster.placeOf(prior.p_odom + R * p));
    }
  }

  std::vector<Eigen::Vector3d> best() const {
    if (points_ == 0) return {};
    std::vector<ScoredShift> shifts;
    for (const ScoredShift& block : bestBlocks())
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          shifts.push_back(scored({0.0, block.ix + dx, block.iy + dy, block.iyaw}, raster_.fine()));
    std::stable_sort(shifts.begin(), shifts.end(), isBetter);  // equal ones: that of the better block
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
  ScoredShift scored(ScoredShift candidate, const std::vector<std::uint8_t>& cells) const {
    const int* const places = &places_[static_cast<std::size_t>(candidate.iyaw + nyaw_) * points_];
    const std::uint8_t* const shifted =
        cells.data() + SearchRaster::placesOfShift(candidate.ix, candidate.iy);
    int sum = 0;
    for (std::size_t i = 0; i < points_; ++i) sum += shifted[places[i]];
    const Eigen::Vector3d shift = candidate.shift();
    candidate.score =
        searchScore(sum / (2.0 * static_cast<double>(points_)), shift.dot(information_ * shift));
    return candidate;
  }

  std::vector<ScoredShift> bestBlocks() const {
    std::vector<ScoredShift> blocks;
    for (int k = -nyaw_; k <= nyaw_; ++k)
      for (int ix = -nx_; ix <= nx_ + 1; ix += kCoarse)
        for (int iy = -ny_; iy <= ny_ + 1; iy += kCoarse)
          blocks.push_back(scored({0.0, ix, iy, k}, raster_.coarse()));
    const auto end = blocks.begin() + static_cast<std::ptrdiff_t>(std::min(kMostCoarse, blocks.size()));
    std::partial_sort(blocks.begin(), end, blocks.end(), isBetterOrFirst);
    blocks.erase(end, blocks.end());
    return blocks;
  }

  const SearchRaster& raster_;
  std::size_t points_ = 0;
  std::vector<int> places_;  ///< in the raster, of the points at the prior's position, for each rotation
  Eigen::Matrix3d information_;
  int nx_, ny_, nyaw_;
};

}  // namespace

double searchScore(double share, double squared_shift) {
  return kWeight * share - 0.5 * std::min(9.0, squared_shift);
}

std::vector<Eigen::Vector3d> searchShifts(const std::vector<Eigen::Vector2d>& points_base,
                                          const SearchRaster& raster, const PlanarState& prior,
                                          const Eigen::Matrix3d& prior_covariance) {
  return ShiftSearch(points_base, raster, prior, prior_covariance).best();
}

}  // namespace stereo_nav::odometry
