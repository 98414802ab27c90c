#include "navigation/obstacles/evidence_layer.h"

#include <algorithm>

namespace stereo_nav::navigation {
namespace {

// Two looks make an obstacle; five without it take it away again at the most.
constexpr int kOccupiedStep = 12, kFreeStep = -9;
constexpr int kMost = 60, kLeast = -30;
constexpr int kOccupiedFrom = 20, kFreeTo = -9;
constexpr std::uint8_t kSeenFree = 1, kSeenOccupied = 2;

}  // namespace

EvidenceLayer::EvidenceLayer(int side_cells, double memory_s, int near_cells, double near_memory_s)
    : side_(side_cells),
      memory_s_(memory_s),
      near_cells_(near_cells),
      near_memory_s_(near_memory_s),
      cells_(static_cast<std::size_t>(side_cells * side_cells)),
      shifted_(cells_.size()) {}

void EvidenceLayer::clearAll() {
  std::fill(cells_.begin(), cells_.end(), Cell());
}

void EvidenceLayer::shift(grid::Cell by) {
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      const grid::Cell from{x + by.x, y + by.y};
      shifted_[static_cast<std::size_t>(y * side_ + x)] = contains(from) ? at(from) : Cell();
    }
  }
  cells_.swap(shifted_);
}

void EvidenceLayer::beginLook(double time_s) {
  if (!any_look_ || time_s < now_s_ - memory_s_) {  // the clock was set back
    clearAll();
    first_s_ = time_s;
    any_look_ = true;
  }
  now_s_ = time_s;
}

void EvidenceLayer::seeOccupied(grid::Cell cell) {
  if (contains(cell)) at(cell).look |= kSeenOccupied;
}

void EvidenceLayer::seeFree(grid::Cell cell) {
  if (contains(cell)) at(cell).look |= kSeenFree;
}

bool EvidenceLayer::isNear(std::size_t cell) const {
  const int x = static_cast<int>(cell) % side_ - side_ / 2;
  const int y = static_cast<int>(cell) / side_ - side_ / 2;
  return x * x + y * y < near_cells_ * near_cells_;
}

void EvidenceLayer::endLook() {
  const auto now = static_cast<float>(now_s_ - first_s_);
  const auto memory = static_cast<float>(memory_s_);
  const auto near_memory = static_cast<float>(near_memory_s_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    Cell& cell = cells_[i];
    if (cell.look != 0) {
      const int step = (cell.look & kSeenOccupied) != 0 ? kOccupiedStep : kFreeStep;
      cell.log_odds = static_cast<std::int8_t>(std::clamp(cell.log_odds + step, kLeast, kMost));
      cell.seen_s = now;
      cell.look = 0;
    } else if (now - cell.seen_s > memory && (now - cell.seen_s > near_memory || !isNear(i))) {
      cell.log_odds = 0;
    }
  }
}

EvidenceLayer::State EvidenceLayer::state(std::size_t cell) const {
  const int log_odds = cells_[cell].log_odds;
  return log_odds >= kOccupiedFrom ? State::kOccupied : log_odds <= kFreeTo ? State::kFree : State::kUnknown;
}

}  // namespace stereo_nav::navigation
