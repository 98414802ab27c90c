#include "navigation/planner/shortcut.h"

#include <cmath>

namespace stereo_nav::navigation {
namespace {

/// One pass from the start to the end.
CellPath shortenedOnce(const RobotSpace& space, const CellPath& path, double slack) {
  CellPath result{path.front()};
  const auto turns = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& at, const Eigen::Vector2d& to) {
    return space.rule() == HeadingRule::kKept ||
           space.fitsTurning(at, space.headingAlong(at - from), space.headingAlong(to - at));
  };
  std::size_t last = 0;
  while (last + 1 < path.size()) {
    std::size_t next = last + 1;
    double replaced = space.costAlong(path[last], path[next]);
    for (std::size_t end = last + 2; end < path.size(); ++end) {
      replaced += space.costAlong(path[end - 1], path[end]);
      if (space.costAlong(path[last], path[end]) > (1.0 + slack) * replaced) break;
      if (!space.fitsAlong(path[last], path[end])) break;
      const bool turns_here = result.size() < 2 || turns(result[result.size() - 2], path[last], path[end]);
      if (turns_here && (end + 1 == path.size() || turns(path[last], path[end], path[end + 1]))) next = end;
    }
    last = next;
    result.push_back(path[last]);
  }
  return result;
}

}  // namespace

CellPath bendsOf(const CellPath& path) {
  CellPath bends;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && i + 1 < path.size()) {
      const Eigen::Vector2d before = path[i] - path[i - 1], after = path[i + 1] - path[i];
      const double bend = before.x() * after.y() - before.y() * after.x();
      if (std::fabs(bend) < 1e-9 && before.dot(after) > 0.0) continue;
    }
    bends.push_back(path[i]);
  }
  return bends;
}

CellPath shortened(const RobotSpace& space, const CellPath& path, double slack) {
  CellPath result = bendsOf(path);
  for (std::size_t points = result.size() + 1; result.size() > 2 && result.size() < points;) {
    points = result.size();
    result = shortenedOnce(space, result, slack);
  }
  return result;
}

CellPath thinnedAsPublished(const CellPath& path, int n) {
  CellPath thinned;
  for (std::size_t i = 0; i < path.size(); i += static_cast<std::size_t>(n)) thinned.push_back(path[i]);
  if (!path.empty() && thinned.back() != path.back()) thinned.push_back(path.back());
  return thinned;
}

}  // namespace stereo_nav::navigation
