#pragma once

#include <optional>
#include <string>

#include "grid/map_image.h"
#include "navigation/planner/plan.h"
#include "navigation/planner/planner_params.h"

namespace stereo_nav::tools {

struct PlanOptions {
  std::string map;        ///< map_server's YAML file, or a drawing
  std::string scenarios;  ///< of the public benchmark, instead of a map
  grid::DrawingParams drawing;
  navigation::PlanarPose start;
  Eigen::Vector2d goal_m = Eigen::Vector2d::Zero();
  std::optional<double> goal_heading_rad;
  navigation::PlannerParams planner;
  bool as_published = false;
  int thin_every = 20;
  std::string image, csv, text;  ///< what to write; empty: not
};

/// Nothing when help was asked for and printed. Throws InputError or ParameterError.
std::optional<PlanOptions> parsePlanOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
