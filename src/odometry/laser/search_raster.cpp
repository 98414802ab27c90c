#include "odometry/laser/search_raster.h"

#include <algorithm>
#include <cstdlib>

namespace stereo_nav::odometry {

void SearchRaster::draw(const LineMap& map, const Eigen::Vector2d& middle) {
  if (version_ == map.version() && middle_ == middle) return;
  version_ = map.version();
  middle_ = middle;
  origin_ = middle - Eigen::Vector2d::Constant(0.5 * (kDrawn - 1) * kCell_m);
  fine_.assign(static_cast<std::size_t>(kSide * kSide), 0);
  coarse_.assign(fine_.size(), 0);
  for (const auto& scan : map.scans())
    for (const Eigen::Vector2d& p : scan) mark(p);
}

void SearchRaster::mark(const Eigen::Vector2d& p) {
  const Eigen::Array2d cells = (p - origin_).array() / kCell_m;
  if (!(cells >= 2.0).all() || !(cells < kDrawn - 2).all()) return;
  const int place = placeOf(p);
  if (fine_[static_cast<std::size_t>(place)] == 2) return;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const auto i = static_cast<std::size_t>(place + placesOfShift(dx, dy));
      const int apart = std::max(std::abs(dx), std::abs(dy));
      fine_[i] = std::max<std::uint8_t>(fine_[i], apart == 0 ? 2 : apart == 1 ? 1 : 0);
      coarse_[i] = std::max<std::uint8_t>(coarse_[i], apart <= 1 ? 2 : 1);
    }
  }
}

}  // namespace stereo_nav::odometry
