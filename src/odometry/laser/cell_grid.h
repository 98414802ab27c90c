#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <unordered_map>

namespace stereo_nav::odometry {

/// Cells of a plane without bounds, in tiles of eight by eight. What is looked up in succession lies near to
/// each other, mostly in the same tile, which then is at hand; cells stay where they are in memory.
template <class Cell>
class CellGrid {
 public:
  /// The cell, made where there is none.
  Cell& at(int ix, int iy) {
    if (Cell* cell = find(ix, iy)) return *cell;
    const std::uint64_t key = keyOf(ix, iy);
    last_ = (tiles_[key] = std::make_unique<Tile>()).get();
    last_key_ = key;
    return (*last_)[placeOf(ix, iy)];
  }

  /// The cell, or nothing where no tile has it.
  Cell* find(int ix, int iy) {
    const std::uint64_t key = keyOf(ix, iy);
    if (last_ == nullptr || key != last_key_) {
      const auto found = tiles_.find(key);
      if (found == tiles_.end()) return nullptr;
      last_ = found->second.get();
      last_key_ = key;
    }
    return &(*last_)[placeOf(ix, iy)];
  }

  /// Takes out the tiles of which all cells are `empty`.
  template <class IsEmpty>
  void forget(IsEmpty empty) {
    for (auto tile = tiles_.begin(); tile != tiles_.end();)
      tile = std::all_of(tile->second->begin(), tile->second->end(), empty) ? tiles_.erase(tile)
                                                                            : std::next(tile);
    last_ = nullptr;
  }

  void clear() {
    tiles_.clear();
    last_ = nullptr;
  }

  /// In memory.
  std::size_t cells() const { return tiles_.size() * kCells; }

 private:
  static constexpr int kBits = 3;
  static constexpr int kSide = 1 << kBits;
  static constexpr std::size_t kCells = kSide * kSide;
  using Tile = std::array<Cell, kCells>;

  static std::uint64_t keyOf(int ix, int iy) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(ix >> kBits)) << 32U) |
           static_cast<std::uint32_t>(iy >> kBits);
  }
  static std::size_t placeOf(int ix, int iy) {
    return static_cast<std::size_t>((ix & (kSide - 1)) * kSide + (iy & (kSide - 1)));
  }

  std::unordered_map<std::uint64_t, std::unique_ptr<Tile>> tiles_;
  Tile* last_ = nullptr;
  std::uint64_t last_key_ = 0;
};

}  // namespace stereo_nav::odometry
