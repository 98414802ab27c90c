// Plans a path on a map image, or runs the scenarios of a public benchmark.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "core/atomic_file.h"
#include "core/processor_time.h"
#include "grid/map_file.h"
#include "navigation/planner/path_file.h"
#include "navigation/planner/path_planner.h"
#include "navigation/planner/published_plan.h"
#include "stereo_nav/core/input_error.h"
#include "tools/common/program.h"
#include "tools/plan/path_drawing.h"
#include "tools/plan/plan_options.h"
#include "tools/plan/scenario_run.h"

namespace stereo_nav::tools {
namespace {

constexpr int kNoPath = 1;

grid::OccupancyGrid readMap(const PlanOptions& options) {
  const std::string extension = std::filesystem::path(options.map).extension().string();
  if (extension == ".yaml" || extension == ".yml") return grid::loadMap(options.map);
  return grid::gridOfDrawing(grid::readMapImage(options.map), options.drawing);
}

/// The path of the published work between the same places, with the robot's outline taken off the floor.
navigation::Plan planAsPublished(const PlanOptions& options, const navigation::PathPlanner& planner) {
  const navigation::RobotSpace& space = planner.space();
  const grid::GridGeometry& geometry = space.geometry();
  navigation::PublishedParams params;
  params.thin_every = options.thin_every;
  const grid::Cell start = geometry.cellAt(options.start.position_m), goal = geometry.cellAt(options.goal_m);
  navigation::Plan plan;
  if (!geometry.contains(start) || !geometry.contains(goal)) {
    plan.text = "start or goal is not on the map";
    return plan;
  }
  const auto path =
      navigation::publishedPath(space.collisionsAlong(Eigen::Vector2d::UnitX()), start, goal, params);
  if (!path.found()) {
    plan.text = "no way, as the published work plans";
    return plan;
  }
  navigation::CellPath points;
  for (const grid::Cell cell : path.cells) points.push_back(grid::centreInCells(cell));
  plan = planner.describe(navigation::thinnedAsPublished(points, params.thin_every), options.start);
  plan.text = "planned as the published work does: nothing keeps its thinned path off the obstacles. ";
  return plan;
}

void write(const PlanOptions& options, const grid::OccupancyGrid& map, const navigation::Plan& plan) {
  if (!options.csv.empty()) writeFileAtomically(options.csv, navigation::toCsv(plan.poses));
  if (!options.text.empty()) writeFileAtomically(options.text, navigation::toPublishedText(plan.poses));
  if (options.image.empty()) return;
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", drawPath(map, options.planner.makeFootprint(), plan.poses), bytes);
  writeFileAtomically(options.image, std::string(bytes.begin(), bytes.end()));
}

int run(int argc, char** argv) {
  const auto options = parsePlanOptions(argc, argv);
  if (!options) return 0;
  if (!options->scenarios.empty()) return runScenarios(options->scenarios) ? 0 : kNoPath;
  const grid::OccupancyGrid map = readMap(*options);
  navigation::PathPlanner planner(options->planner);
  const double start_ms = processorTime_ms();
  planner.setMap(map, options->start.heading_rad);
  const double ready_ms = processorTime_ms();
  const navigation::Plan plan =
      options->as_published ? planAsPublished(*options, planner)
                            : planner.plan(options->start, options->goal_m, options->goal_heading_rad);
  const double end_ms = processorTime_ms();
  if (!plan.text.empty()) std::cout << plan.text << "\n";
  if (!plan.found()) return kNoPath;
  std::cout << fmt::format("path of {:.3f} m with {} points, least clearance {:.3f} m\n", plan.length_m,
                           plan.poses.size(), plan.clearance_m)
            << fmt::format("processor time: {:.2f} ms for the map of {} x {} cells, {:.2f} ms for the path\n",
                           ready_ms - start_ms, map.geometry.width, map.geometry.height, end_ms - ready_ms);
  write(*options, map, plan);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("plan", stereo_nav::tools::run, argc, argv);
}
