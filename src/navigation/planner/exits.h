#pragma once

#include <array>
#include <cstdint>

#include "navigation/planner/move_grid.h"

namespace stereo_nav::navigation {

/// As an arrival: the cell is the start, and no move led to it.
constexpr std::uint8_t kNoMove = kMoves;

namespace internal {

/// Of the legal `moves` of a cell that was entered by `arrival`, those that a shortest path may need, where
/// all moves are those of movesOfPoint() and length alone counts. All others lead where a way around this
/// cell is as short (Harabor and Grastien 2011, section "Pruning", with their rule for grids on which no
/// corner is cut).
constexpr std::uint8_t prunedExits(unsigned arrival, unsigned moves) {
  const auto bit = [&](unsigned turned) { return 1U << ((arrival + turned) % kMoves); };
  if (arrival == kNoMove) return static_cast<std::uint8_t>(moves);
  if (arrival % 2 == 1) return static_cast<std::uint8_t>(moves & (bit(0) | bit(1) | bit(7)));
  unsigned needed = bit(0);
  if ((moves & bit(3)) == 0) needed |= bit(2) | bit(1);  // an obstacle behind, to the left
  if ((moves & bit(5)) == 0) needed |= bit(6) | bit(7);
  return static_cast<std::uint8_t>(moves & needed);
}

/// The moves that can be turned to from the direction of `arrival`, one way round or the other, where bit k
/// of `turns` allows to turn between moves k and k + 1.
constexpr std::uint8_t turningExits(unsigned arrival, unsigned turns) {
  if (arrival == kNoMove) return 0xFF;
  unsigned exits = 1U << arrival;
  for (unsigned step = 0; step < kMoves; ++step) {  // to the left
    if (((turns >> ((arrival + step) % kMoves)) & 1U) == 0) break;
    exits |= 1U << ((arrival + step + 1) % kMoves);
  }
  for (unsigned step = 1; step <= kMoves; ++step) {  // to the right
    const unsigned k = (arrival + kMoves - step) % kMoves;
    if (((turns >> k) & 1U) == 0) break;
    exits |= 1U << k;
  }
  return static_cast<std::uint8_t>(exits);
}

using ExitTable = std::array<std::array<std::uint8_t, 256>, kMoves + 1>;

constexpr ExitTable tabulate(std::uint8_t (*exits)(unsigned, unsigned)) {
  ExitTable table{};
  for (unsigned arrival = 0; arrival <= kMoves; ++arrival)
    for (unsigned byte = 0; byte < 256; ++byte) table[arrival][byte] = exits(arrival, byte);
  return table;
}

}  // namespace internal

/// Both rules as tables: [arrival][byte of the cell].
inline constexpr internal::ExitTable kPrunedExits = internal::tabulate(internal::prunedExits);
inline constexpr internal::ExitTable kTurningExits = internal::tabulate(internal::turningExits);

}  // namespace stereo_nav::navigation
