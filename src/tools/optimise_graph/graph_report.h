#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mapping/map/g2o_file.h"
#include "mapping/map/robust_optimiser.h"

namespace stereo_nav::tools {

/// What optimise_graph has found. Positions are those of the vertices, z = 0 in the plane.
struct GraphRun {
  std::string file;
  bool robust = false;
  std::size_t vertices = 0, edges = 0, loops = 0, false_loops = 0;
  mapping::OptimiserResult optimiser;
  mapping::RobustResult judgement;         ///< with `robust`
  double processor_time_ms = 0.0;          ///< of the optimisation, without reading and writing
  std::optional<double> rms_from_clean_m;  ///< with false loops: distance from the optimum without them
  std::vector<Eigen::Vector3d> before_m, after_m;
  std::vector<long long> ids;
  std::vector<std::pair<std::size_t, std::size_t>> ends;  ///< of each edge
};

std::string toJson(const GraphRun& run);
/// One line a loop: from,to,kept,chi_square,agrees,reason.
std::string loopsCsv(const GraphRun& run);
/// gnuplot's script for a picture from above: path before and after, loops kept and rejected.
std::string pictureScript(const GraphRun& run);
void print(const GraphRun& run);

}  // namespace stereo_nav::tools
