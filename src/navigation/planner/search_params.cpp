#include "navigation/planner/search_params.h"

namespace stereo_nav::navigation {

void SearchParams::describe(ParameterVisitor& visitor) {
  visitEnum(
      visitor, "heuristic", heuristic,
      {{"octile", Heuristic::kOctile},
       {"euclidean", Heuristic::kEuclidean},
       {"manhattan", Heuristic::kManhattan}},
      "estimate of the way that remains; manhattan is inadmissible with eight neighbours: its paths may be longer than "
      "need be");
  visitor.real(
      "weight", weight, {1.0, 10.0}, "",
      "factor of that estimate; above 1 it is inadmissible: the path is at most this many times as long as the "
      "shortest");
}

}  // namespace stereo_nav::navigation
