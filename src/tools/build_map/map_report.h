#pragma once

#include <string>

#include "tools/build_map/map_run.h"

namespace stereo_nav::tools {

/// What a run comes to.
struct MapFigures {
  eval::EvaluationSummary before, after;
  std::size_t candidates = 0, accepted = 0, kept = 0;
};
MapFigures figuresOf(const MapRun& run);

/// The same bytes in each run.
std::string summaryJson(const MapRun& run, const MapFigures& figures);
std::string timingJson(const MapRun& run);
/// A row for each loop of the map.
std::string loopsCsv(const MapRun& run);
/// A script for gnuplot: the way before and after, the truth, and the loops.
std::string pictureScript(const MapRun& run);
void print(const MapRun& run, const MapFigures& figures);

}  // namespace stereo_nav::tools
