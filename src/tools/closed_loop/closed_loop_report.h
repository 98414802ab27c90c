#pragma once

#include <string>
#include <vector>

#include "tools/closed_loop/goal_run.h"

namespace stereo_nav::tools {

/// All goals of a run.
struct LoopResults {
  std::vector<GoalResult> goals;
  std::size_t collisions = 0, frames = 0, frames_lost = 0;

  std::size_t reached() const;
  /// Arrived by its own account, and somewhere else.
  std::size_t wrong() const;
};

/// A row for each goal.
std::string toCsv(const LoopResults& results);
/// A row for each period.
std::string toCsv(const std::vector<TracePoint>& trace);
std::string toJson(const LoopResults& results);
/// For a terminal.
std::string table(const LoopResults& results);
/// An SVG: what stands there, goals, the true way and the one that the robot took it for. Files of gnuplot
/// lie beside `path_prefix` meanwhile. Throws GnuplotError.
std::string drawWay(const LoopResults& results, const std::vector<TracePoint>& trace,
                    const grid::OccupancyGrid& walls, const std::string& title,
                    const std::string& path_prefix);

}  // namespace stereo_nav::tools
