#include "navigation/planner/grid_search.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <queue>

#include "navigation/planner/benchmark_map.h"
#include "unit/grid/random_obstacles.h"

namespace stereo_nav::navigation {
namespace {

using grid::Cell;

/// Dijkstra's algorithm, as plain as can be: the cost from `start` to every cell, infinite where there is no
/// way.
std::vector<double> plainCosts(const MoveGrid& grid, Cell start) {
  std::vector<double> costs(grid.moves.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>,
                      std::greater<>>
      open;
  costs[grid.index(start)] = 0.0;
  open.push({0.0, grid.index(start)});
  while (!open.empty()) {
    const auto [cost, here] = open.top();
    open.pop();
    if (cost > costs[here]) continue;
    for (std::size_t k = 0; k < kMoves; ++k) {
      if (((grid.moves[here] >> k) & 1U) == 0) continue;
      const std::size_t there =
          here + static_cast<std::size_t>(kMoveSteps[k].x + kMoveSteps[k].y * grid.width);
      const double factor =
          grid.costs[0] == nullptr ? 1.0 : 1.0 + grid.costs[k][there] / double{MoveGrid::kCostUnits};
      const double next = cost + (k % 2 == 0 ? 1.0 : std::sqrt(2.0)) * factor;
      if (next >= costs[there] - 1e-12) continue;
      costs[there] = next;
      open.push({next, there});
    }
  }
  return costs;
}

void expectLegal(const MoveGrid& grid, const GridPath& path, Cell start, Cell goal) {
  ASSERT_TRUE(path.found());
  EXPECT_TRUE(path.cells.front() == start && path.cells.back() == goal);
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    bool legal = false;
    for (std::size_t k = 0; k < kMoves; ++k) {
      const Cell next{path.cells[i - 1].x + kMoveSteps[k].x, path.cells[i - 1].y + kMoveSteps[k].y};
      legal |= next == path.cells[i] && ((grid.moves[grid.index(path.cells[i - 1])] >> k) & 1U) != 0;
    }
    EXPECT_TRUE(legal) << "step " << i;
  }
}

double costOf(const MoveGrid& grid, const GridPath& path) {
  double cost = 0.0;
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    for (std::size_t k = 0; k < kMoves; ++k) {
      if (!(Cell{path.cells[i - 1].x + kMoveSteps[k].x, path.cells[i - 1].y + kMoveSteps[k].y} ==
            path.cells[i]))
        continue;
      cost += (k % 2 == 0 ? 1.0 : std::sqrt(2.0)) *
              (1.0 + grid.costs[k][grid.index(path.cells[i])] / double{MoveGrid::kCostUnits});
    }
  }
  return cost;
}

TEST(GridSearch, FindsTheShortestPathOnRandomGrids) {
  GridSearch search;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const auto obstacles = grid::randomObstacles(37, 23, 0.05 + 0.005 * seed, seed);
    const MoveGrid grid = movesOfPoint(obstacles);
    for (const Cell start : {Cell{0, 0}, Cell{18, 11}, Cell{36, 22}}) {
      if (obstacles(start.y, start.x) != 0) continue;
      const auto costs = plainCosts(grid, start);
      for (int y = 0; y < 23; y += 2) {
        for (int x = 0; x < 37; x += 3) {
          const double shortest = costs[grid.index({x, y})];
          for (const Heuristic heuristic : {Heuristic::kOctile, Heuristic::kEuclidean}) {
            const GridPath path = search.find(grid, start, {x, y}, {heuristic, 1.0});
            ASSERT_EQ(path.found(), std::isfinite(shortest)) << seed;
            if (!path.found()) continue;
            ASSERT_NEAR(path.length_cells, shortest, 1e-9) << "seed " << seed << " to " << x << " " << y;
            expectLegal(grid, path, start, {x, y});
          }
        }
      }
    }
  }
}

TEST(GridSearch, FindsTheCheapestPathWhereCellsCost) {
  GridSearch search;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    MoveGrid grid = movesOfPoint(grid::randomObstacles(31, 29, 0.2, seed));
    std::mt19937 generator(seed);
    std::vector<std::uint8_t> costs(grid.moves.size());
    for (auto& cost : costs) cost = static_cast<std::uint8_t>(generator() % 200);
    grid.costs.fill(costs.data());
    const auto cheapest = plainCosts(grid, {15, 14});
    for (int y = 0; y < 29; y += 3) {
      for (int x = 0; x < 31; x += 3) {
        const GridPath path = search.find(grid, {15, 14}, {x, y});
        ASSERT_EQ(path.found(), std::isfinite(cheapest[grid.index({x, y})]));
        if (!path.found()) continue;
        ASSERT_NEAR(costOf(grid, path), cheapest[grid.index({x, y})], 0.02) << seed;  // whole numbers
      }
    }
  }
}

TEST(GridSearch, CutsNoCorner) {
  cv::Mat_<std::uint8_t> obstacles(3, 3, std::uint8_t{0});
  obstacles(1, 1) = 1;
  GridSearch search;
  EXPECT_NEAR(search.find(movesOfPoint(obstacles), {0, 0}, {2, 2}).length_cells, 4.0, 1e-12);
  obstacles = (cv::Mat_<std::uint8_t>(2, 2) << 0, 1, 1, 0);
  EXPECT_FALSE(search.find(movesOfPoint(obstacles), {0, 0}, {1, 1}).found());
}

TEST(GridSearch, OfTheStartItselfIsOneCell) {
  GridSearch search;
  const GridPath path =
      search.find(movesOfPoint(cv::Mat_<std::uint8_t>(4, 4, std::uint8_t{0})), {2, 1}, {2, 1});
  EXPECT_EQ(path.cells.size(), 1U);
  EXPECT_EQ(path.length_cells, 0.0);
}

TEST(GridSearch, WithAWeightIsWithinThatFactor) {
  GridSearch search;
  double longer = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const MoveGrid grid = movesOfPoint(grid::randomObstacles(60, 60, 0.3, seed));
    const GridPath shortest = search.find(grid, {1, 1}, {58, 58});
    if (!shortest.found()) continue;
    const GridPath weighted = search.find(grid, {1, 1}, {58, 58}, {Heuristic::kOctile, 2.5});
    expectLegal(grid, weighted, {1, 1}, {58, 58});
    EXPECT_LE(weighted.length_cells, 2.5 * shortest.length_cells);
    EXPECT_LT(weighted.expanded, shortest.expanded);
    const GridPath manhattan = search.find(grid, {1, 1}, {58, 58}, {Heuristic::kManhattan, 1.0});
    expectLegal(grid, manhattan, {1, 1}, {58, 58});
    longer += manhattan.length_cells - shortest.length_cells;
  }
  EXPECT_GT(longer, 0.0) << "the Manhattan estimate is inadmissible with eight neighbours";
}

TEST(GridSearch, TurnsOnlyWhereItMay) {
  MoveGrid grid = movesOfPoint(cv::Mat_<std::uint8_t>(9, 9, std::uint8_t{0}));
  std::vector<std::uint8_t> no_costs(grid.moves.size(), 0);
  grid.costs.fill(no_costs.data());
  grid.turns.assign(grid.moves.size(), 0);
  GridSearch search;
  EXPECT_FALSE(search.find(grid, {0, 0}, {8, 4}).found());
  grid.turns[grid.index({4, 4})] = 1U;  // between +x and the diagonal
  const GridPath path = search.find(grid, {0, 0}, {8, 4});
  ASSERT_TRUE(path.found());
  EXPECT_TRUE(path.cells[4] == (Cell{4, 4}));
  EXPECT_FALSE(search.find(grid, {0, 0}, {8, 4}, {}, 1U).found()) << "it cannot begin along +x";
}

/// Maps of the public benchmark, whose optimal lengths are known.
TEST(GridSearch, SolvesEveryScenarioOfTheBenchmarkOptimally) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  std::size_t solved = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(data) / "grid_maps")) {
    if (file.path().extension() != ".scen") continue;
    const auto scenarios = readBenchmarkScenarios(file.path().string());
    const MoveGrid grid = movesOfPoint(readBenchmarkMap(file.path().parent_path() / scenarios.front().map));
    GridSearch search;
    for (const auto& scenario : scenarios) {
      const GridPath path = search.find(grid, scenario.start, scenario.goal);
      ASSERT_EQ(path.found(), scenario.solvable());
      if (path.found()) {
        EXPECT_NEAR(path.length_cells, scenario.optimal_length,
                    1e-4 * std::max(1.0, scenario.optimal_length));
      }
      ++solved;
    }
  }
  EXPECT_GT(solved, 3000U);
}

}  // namespace
}  // namespace stereo_nav::navigation
