#include "navigation/planner/grid_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "navigation/planner/exits.h"

namespace stereo_nav::navigation {
namespace {

constexpr std::uint32_t kStraight = 5741, kDiagonal = 8119;
constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
/// What is longer than this is not followed, so that no sum overflows.
constexpr std::uint32_t kLongest = 3'000'000'000;
/// Width of a bucket, 2^kBucketBits: 0.36 cells.
constexpr unsigned kBucketBits = 11;

constexpr std::array<std::uint32_t, kMoves> kLengths{
    {kStraight, kDiagonal, kStraight, kDiagonal, kStraight, kDiagonal, kStraight, kDiagonal}};

std::uint32_t octile(int dx, int dy) {
  const auto longer = static_cast<std::uint32_t>(std::max(dx, dy));
  const auto shorter = static_cast<std::uint32_t>(std::min(dx, dy));
  return kStraight * longer + (kDiagonal - kStraight) * shorter;
}

}  // namespace

GridPath GridSearch::find(const MoveGrid& grid, grid::Cell start, grid::Cell goal, const SearchParams& params,
                          std::uint8_t start_moves) {
  const bool prune = grid.costs[0] == nullptr && params.admissible();
  if (params.heuristic == Heuristic::kOctile && params.weight == 1.0) {
    return search(grid, start, goal, start_moves, prune, octile);
  }
  const double unit = params.weight * kStraight;
  const auto scaled = [](double f) { return static_cast<std::uint32_t>(std::min(f, double{kLongest})); };
  switch (params.heuristic) {
    case Heuristic::kEuclidean:
      return search(grid, start, goal, start_moves, prune,
                    [=](int dx, int dy) { return scaled(unit * std::hypot(dx, dy)); });
    case Heuristic::kManhattan:
      return search(grid, start, goal, start_moves, prune,
                    [=](int dx, int dy) { return scaled(unit * (dx + dy)); });
    case Heuristic::kOctile:
      break;
  }
  return search(grid, start, goal, start_moves, prune,
                [=](int dx, int dy) { return scaled(params.weight * octile(dx, dy)); });
}

template <class Heuristic>
GridPath GridSearch::search(const MoveGrid& grid, grid::Cell start, grid::Cell goal, std::uint8_t start_moves,
                            bool prune, const Heuristic& heuristic) {
  begin(grid.moves.size());
  const auto remaining = [&](int x, int y) { return heuristic(std::abs(x - goal.x), std::abs(y - goal.y)); };
  std::size_t expanded = 0;
  std::uint32_t best = start == goal ? 0 : kFar;
  nodes_[grid.index(start)] = {0, run_, kNoMove, false};
  bucket_ = remaining(start.x, start.y) >> kBucketBits;
  push(remaining(start.x, start.y), 0, start.x, start.y);
  const bool costed = grid.costs[0] != nullptr;
  while (advance(best)) {
    const Entry entry = pop();
    const std::size_t here = grid.index({entry.x, entry.y});
    Node& node = nodes_[here];
    if (node.closed || node.g != entry.g) continue;
    if (best != kFar && entry.g + remaining(entry.x, entry.y) >= best) continue;
    node.closed = true;
    ++expanded;
    unsigned moves = grid.moves[here];
    if (node.arrival == kNoMove) moves &= start_moves;
    if (prune) moves = kPrunedExits[node.arrival][moves];
    if (!grid.turns.empty()) moves &= kTurningExits[node.arrival][grid.turns[here]];
    for (; moves != 0; moves &= moves - 1) {
      const auto k = static_cast<std::size_t>(__builtin_ctz(moves));
      const int x = entry.x + kMoveSteps[k].x, y = entry.y + kMoveSteps[k].y;
      const std::size_t there = grid.index({x, y});
      std::uint32_t g = entry.g + kLengths[k];
      if (costed) g += kLengths[k] * grid.costs[k][there] / MoveGrid::kCostUnits;
      Node& next = nodes_[there];
      if ((next.run == run_ && next.g <= g) || g > kLongest) continue;
      next = {g, run_, static_cast<std::uint8_t>(k), false};
      const std::uint32_t rest = remaining(x, y);
      if (rest == 0) best = g;
      push(g + rest, g, x, y);
    }
  }
  GridPath path;
  if (best != kFar) path = trace(grid, start, goal);
  path.expanded = expanded;
  return path;
}

void GridSearch::begin(std::size_t cells) {
  if (nodes_.size() != cells || run_ == std::numeric_limits<std::uint16_t>::max()) {
    nodes_.assign(cells, {0, 0, kNoMove, false});
    run_ = 0;
  }
  ++run_;
  std::fill(heads_.begin(), heads_.end(), -1);
  entries_.clear();
  unused_ = -1;
  last_bucket_ = 0;
}

void GridSearch::push(std::uint32_t f, std::uint32_t g, int x, int y) {
  const std::size_t bucket = f >> kBucketBits;
  if (bucket >= heads_.size()) heads_.resize(bucket + bucket / 2 + 64, -1);
  std::int32_t slot = unused_;
  if (slot >= 0) {
    unused_ = entries_[static_cast<std::size_t>(slot)].next;
  } else {
    slot = static_cast<std::int32_t>(entries_.size());
    entries_.emplace_back();
  }
  entries_[static_cast<std::size_t>(slot)] = {g, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                              heads_[bucket]};
  heads_[bucket] = slot;
  bucket_ = std::min(bucket_, bucket);  // an inadmissible estimate may fall
  last_bucket_ = std::max(last_bucket_, bucket);
}

bool GridSearch::advance(std::uint32_t best) {
  const std::size_t end = std::min<std::size_t>(last_bucket_ + 1, (std::size_t{best} >> kBucketBits) + 1);
  while (bucket_ < end && heads_[bucket_] < 0) ++bucket_;
  return bucket_ < end;
}

GridSearch::Entry GridSearch::pop() {
  const std::int32_t slot = heads_[bucket_];
  Entry& entry = entries_[static_cast<std::size_t>(slot)];
  heads_[bucket_] = entry.next;
  entry.next = unused_;
  unused_ = slot;
  return entry;
}

GridPath GridSearch::trace(const MoveGrid& grid, grid::Cell start, grid::Cell goal) const {
  GridPath path;
  std::size_t straight = 0, diagonal = 0;
  grid::Cell cell = goal;
  path.cells.push_back(cell);
  while (cell != start) {
    const std::size_t k = nodes_[grid.index(cell)].arrival;
    ++(k % 2 == 0 ? straight : diagonal);
    cell = {cell.x - kMoveSteps[k].x, cell.y - kMoveSteps[k].y};
    path.cells.push_back(cell);
  }
  std::reverse(path.cells.begin(), path.cells.end());
  path.length_cells = static_cast<double>(straight) + std::sqrt(2.0) * static_cast<double>(diagonal);
  return path;
}

}  // namespace stereo_nav::navigation
