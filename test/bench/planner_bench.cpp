// Processor time of path planning. On each map of the public benchmark, scenario by scenario in turn: a plain
// A* with a heap and doubles, the anchor, and ours. Then on the contest field: planning anew after a box has
// appeared or gone.
//
//   planner_bench_test FOLDER_OF_MAPS
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <queue>
#include <random>

#include "core/processor_time.h"
#include "core/statistics.h"
#include "navigation/planner/benchmark_map.h"
#include "navigation/planner/path_planner.h"
#include "unit/navigation/planner/planner_scene.h"

namespace stereo_nav::navigation {
namespace {

template <class Work>
double timed_ms(const Work& work) {
  const double start_ms = processorTime_ms();
  work();
  return processorTime_ms() - start_ms;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

/// A* as textbooks have it: octile estimate, binary heap, entries that are outdated stay in it.
class PlainSearch {
 public:
  explicit PlainSearch(const MoveGrid& grid)
      : grid_(grid), g_(grid.moves.size()), run_of_(grid.moves.size(), 0) {}

  double length(grid::Cell start, grid::Cell goal) {
    ++run_;
    std::priority_queue<Entry> open;
    reach(grid_.index(start), 0.0);
    open.push({estimate(start, goal), 0.0, start});
    while (!open.empty()) {
      const Entry entry = open.top();
      open.pop();
      if (entry.cell == goal) return entry.g;
      const std::size_t here = grid_.index(entry.cell);
      if (entry.g > g_[here]) continue;
      for (std::size_t k = 0; k < kMoves; ++k) {
        if (((grid_.moves[here] >> k) & 1U) == 0) continue;
        const grid::Cell next{entry.cell.x + kMoveSteps[k].x, entry.cell.y + kMoveSteps[k].y};
        const double g = entry.g + (k % 2 == 0 ? 1.0 : std::sqrt(2.0));
        const std::size_t there = grid_.index(next);
        if (run_of_[there] == run_ && g_[there] <= g + 1e-9) continue;
        reach(there, g);
        open.push({g + estimate(next, goal), g, next});
      }
    }
    return -1.0;
  }

 private:
  struct Entry {
    double f, g;
    grid::Cell cell;
    bool operator<(const Entry& other) const { return f > other.f || (f == other.f && g < other.g); }
  };
  static double estimate(grid::Cell a, grid::Cell b) {
    const double dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
    return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
  }
  void reach(std::size_t cell, double g) {
    g_[cell] = g;
    run_of_[cell] = run_;
  }

  const MoveGrid& grid_;
  std::vector<double> g_;
  std::vector<unsigned> run_of_;
  unsigned run_ = 0;
};

void compareOn(const std::filesystem::path& scenario_file) {
  const auto scenarios = readBenchmarkScenarios(scenario_file.string());
  const MoveGrid grid = movesOfPoint(readBenchmarkMap(scenario_file.parent_path() / scenarios.front().map));
  PlainSearch plain(grid);
  GridSearch search;
  std::vector<double> plain_ms, ours_ms;
  std::size_t optimal = 0, solvable = 0;
  for (const auto& scenario : scenarios) {
    if (!scenario.solvable()) continue;
    ++solvable;
    plain_ms.push_back(timed_ms([&] { plain.length(scenario.start, scenario.goal); }));
    GridPath path;
    ours_ms.push_back(timed_ms([&] { path = search.find(grid, scenario.start, scenario.goal); }));
    if (std::fabs(path.length_cells - scenario.optimal_length) <=
        1e-4 * std::max(1.0, scenario.optimal_length))
      ++optimal;
  }
  fmt::print(
      "{:24} {:3} x {:3}: optimal {} of {}, plain {:.3f} ms, ours {:.3f} ms (95 %: {:.3f}), ratio {:.3f}\n",
      scenario_file.stem().stem().string(), grid.width, grid.height, optimal, solvable, mean(plain_ms),
      mean(ours_ms), quantile(ours_ms, 0.95), mean(ours_ms) / mean(plain_ms));
}

void planAnew(HeadingRule rule, const char* name) {
  grid::OccupancyGrid field = contestField();
  PlannerParams params = contestRobot();
  params.heading = rule;
  PathPlanner planner(params);
  const double prepare_ms = timed_ms([&] { planner.setMap(field); });
  const PlanarPose start{{0.55, 0.35}, kPi / 2.0};
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> x(0.0, 5.4), y(1.2, 9.0), size(0.1, 0.6);
  std::vector<double> update_ms, plan_ms, both_ms;
  std::size_t points = 0, found = 0;
  double clearance_m = 1e9;
  for (int i = 0; i < 300; ++i) {
    const double x0 = x(generator), y0 = y(generator), x1 = x0 + size(generator), y1 = y0 + size(generator);
    const grid::OccupancyGrid before = field;
    const cv::Rect changed = setBox(field, x0, y0, x1, y1);
    Plan plan;
    update_ms.push_back(timed_ms([&] { planner.update(field, changed); }));
    plan_ms.push_back(timed_ms([&] { plan = planner.plan(start, {4.3, 10.0}); }));
    both_ms.push_back(update_ms.back() + plan_ms.back());
    if (plan.found()) {
      ++found;
      points = std::max(points, plan.poses.size());
      if (i % 10 == 0)
        clearance_m = std::min(clearance_m, leastDistance(field, params.makeFootprint(), plan.poses, rule));
    }
    field = before;
    planner.update(field, changed);
  }
  fmt::print(
      "{}: map {:.2f} ms once; anew after a box: update {:.2f}, plan {:.2f}, both: mean {:.2f}, 95 % {:.2f}, most {:.2f} ms; {} of 300 have a "
      "way, at most {} points, outline at least {:.4f} m from obstacles\n",
      name, prepare_ms, mean(update_ms), mean(plan_ms), mean(both_ms), quantile(both_ms, 0.95),
      quantile(both_ms, 1.0), found, points, clearance_m);
}

}  // namespace
}  // namespace stereo_nav::navigation

int main(int argc, char** argv) {
  cv::setNumThreads(1);  // all that is done is in the time of this thread
  if (argc > 1) {
    std::vector<std::filesystem::path> files;
    for (const auto& file : std::filesystem::directory_iterator(argv[1]))
      if (file.path().extension() == ".scen") files.push_back(file.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) stereo_nav::navigation::compareOn(file);
  }
  stereo_nav::navigation::planAnew(stereo_nav::navigation::HeadingRule::kKept, "heading kept");
  stereo_nav::navigation::planAnew(stereo_nav::navigation::HeadingRule::kTravel, "heading along the way");
  return 0;
}
