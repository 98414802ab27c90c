#pragma once

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::navigation {

enum class Heuristic { kOctile, kEuclidean, kManhattan };

/// How A* estimates the way that remains. The defaults find the shortest path; the others are those of the
/// published work.
struct SearchParams {
  /// Octile and Euclidean never overestimate. Manhattan does with eight neighbours: it is inadmissible, and
  /// its paths may be longer than need be.
  Heuristic heuristic = Heuristic::kOctile;
  /// Factor e of the estimate. Above 1 it is inadmissible: the path is at most e times as long as the
  /// shortest.
  double weight = 1.0;

  bool admissible() const { return heuristic != Heuristic::kManhattan && weight <= 1.0; }
  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::navigation
