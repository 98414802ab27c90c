#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid/occupancy_grid.h"
#include "navigation/planner/planner_params.h"
#include "sim/driven_simulation.h"

namespace stereo_nav::tools {

/// The places that a scenario's path leads to, and back to the start where that is wanted. World, m.
std::vector<Eigen::Vector2d> pathGoals(const sim::Scenario& scenario, const Eigen::Vector2d& start,
                                       bool back);

/// Places drawn at random, each of which can be reached from the one before, at least a metre away, with half
/// a metre free around it. World, m. Throws InputError where there is hardly any room.
std::vector<Eigen::Vector2d> randomGoals(const grid::OccupancyGrid& walls,
                                         const navigation::PlannerParams& params,
                                         const Eigen::Vector2d& start, int count, std::uint64_t seed);

}  // namespace stereo_nav::tools
