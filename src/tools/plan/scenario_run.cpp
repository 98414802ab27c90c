#include "tools/plan/scenario_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <vector>

#include "core/processor_time.h"
#include "core/statistics.h"
#include "navigation/planner/benchmark_map.h"
#include "navigation/planner/grid_search.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

/// Lengths in the files have six digits.
constexpr double kTolerance = 1e-4;

struct Score {
  std::size_t solvable = 0, solved = 0, optimal = 0, without_way = 0, expanded = 0;
  std::vector<double> times_ms;  ///< of the solvable ones
  bool all() const { return optimal == solvable; }
};

void run(const navigation::BenchmarkScenario& scenario, const navigation::MoveGrid& moves,
         navigation::GridSearch& search, Score& score) {
  for (const grid::Cell cell : {scenario.start, scenario.goal}) {
    if (cell.x < 0 || cell.y < 0 || cell.x >= moves.width || cell.y >= moves.height)
      throw InputError(fmt::format("{}: a scenario has the cell ({}, {}), which is not on the map",
                                   scenario.map, cell.x, cell.y));
  }
  const double start_ms = processorTime_ms();
  const navigation::GridPath path = search.find(moves, scenario.start, scenario.goal);
  const double time_ms = processorTime_ms() - start_ms;
  if (!scenario.solvable()) {
    ++score.without_way;
    if (path.found())
      throw InputError(scenario.map +
                       ": a path where the file says that there is none; is the map the right one?");
    return;
  }
  ++score.solvable;
  score.times_ms.push_back(time_ms);
  score.expanded += path.expanded;
  if (!path.found()) return;
  ++score.solved;
  if (std::fabs(path.length_cells - scenario.optimal_length) <=
      kTolerance * std::max(1.0, scenario.optimal_length))
    ++score.optimal;
}

void print(const Score& score, double preparation_ms) {
  double sum_ms = 0.0;
  for (const double time_ms : score.times_ms) sum_ms += time_ms;
  const double n = static_cast<double>(std::max<std::size_t>(1, score.solvable));
  std::cout
      << fmt::format("solved {} of {}, with the optimal length {}, without a way as the file says {}\n",
                     score.solved, score.solvable, score.optimal, score.without_way)
      << fmt::format(
             "processor time of a search: mean {:.4f} ms, 95th percentile {:.4f} ms; cells expanded: mean {:.0f}\n",
             sum_ms / n, quantile(score.times_ms, 0.95), static_cast<double>(score.expanded) / n)
      << fmt::format("processor time of preparing the map, once: {:.3f} ms\n", preparation_ms);
}

}  // namespace

bool runScenarios(const std::string& scenario_file) {
  const auto scenarios = navigation::readBenchmarkScenarios(scenario_file);
  if (scenarios.empty()) throw InputError(scenario_file + ": no scenarios");
  const std::filesystem::path name = std::filesystem::path(scenarios.front().map).filename();
  const std::string map_file = (std::filesystem::path(scenario_file).parent_path() / name).string();
  const cv::Mat obstacles = navigation::readBenchmarkMap(map_file);
  const double start_ms = processorTime_ms();
  const navigation::MoveGrid moves = navigation::movesOfPoint(obstacles);
  const double preparation_ms = processorTime_ms() - start_ms;
  std::cout << fmt::format("{}: {} x {} cells, {} scenarios\n", map_file, moves.width, moves.height,
                           scenarios.size());
  navigation::GridSearch search;
  Score score;
  for (const auto& scenario : scenarios) run(scenario, moves, search, score);
  print(score, preparation_ms);
  return score.all();
}

}  // namespace stereo_nav::tools
