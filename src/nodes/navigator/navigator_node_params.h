#pragma once

#include <string>

#include "grid/footprint.h"
#include "navigation/navigator/navigator.h"
#include "navigation/planner/planner_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the navigator node (config/navigator.yaml): its own, those of the navigator, and those of
/// the planner in the section `planner`.
struct NavigatorNodeParams {
  std::string map_frame = "map";
  std::string base_frame = ros_io::frames::kBase;
  double localisation_timeout_s = 1.0;
  navigator::NavigatorParams navigator;
  navigation::PlannerParams planner;

  void describe(ParameterVisitor& visitor) {
    visitor.text("map_frame", map_frame,
                 "frame of goals and ways, where tf has it; without it they are in the odometry's frame");
    visitor.text("base_frame", base_frame, "frame of the robot, of which the odometry must tell the pose");
    visitor.real("localisation_timeout_s", localisation_timeout_s, {0.1, 60.0}, "s",
                 "it stops when the transform from the map to the odometry's frame is older");
    navigator.describe(visitor);
    visitSection(visitor, "planner", planner);
  }
  /// One outline for all: the check of the coming motion takes the rectangle that holds that of the planner.
  /// Throws InputError.
  void shareOutline() {
    Eigen::Vector2d half = Eigen::Vector2d::Zero();
    const grid::Footprint footprint = planner.makeFootprint();
    for (const auto& corner : footprint.corners()) half = half.cwiseMax(corner.cwiseAbs());
    navigator.check.length_m = 2.0 * half.x();
    navigator.check.width_m = 2.0 * half.y();
  }
};

}  // namespace stereo_nav::nodes
