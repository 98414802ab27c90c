#pragma once

#include <string>

#include "navigation/obstacles/obstacle_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the obstacle_grid node: its own, and those of the grid (config/obstacles.yaml).
struct ObstacleGridParams {
  std::string odom_frame = ros_io::frames::kOdom;
  std::string base_frame = ros_io::frames::kBase;
  std::string ranges = "front rear left right";
  bool edges = false;
  double publish_rate_hz = 10.0;
  double tf_wait_s = 0.3;
  double input_timeout_s = 3.0;
  navigation::ObstacleParams grid;

  void describe(ParameterVisitor& visitor) {
    visitor.text("odom_frame", odom_frame, "frame in which the cells have fixed places");
    visitor.text("base_frame", base_frame, "frame of the robot, on the floor");
    visitor.text("ranges", ranges,
                 "names NAME of the range finders range/NAME that are used, separated by blanks");
    visitor.flag("edges", edges,
                 "edges that stand above the floor are looked for in the rectified images, too");
    visitor.real("publish_rate_hz", publish_rate_hz, {0.1, 100.0}, "Hz",
                 "how often `obstacles` is published at most");
    visitor.real("tf_wait_s", tf_wait_s, {0.0, 5.0}, "s",
                 "a message waits this long for the robot's pose at its stamp, then it is dropped");
    visitor.real("input_timeout_s", input_timeout_s, {0.1, 60.0}, "s",
                 "silence of all inputs before the node explains it");
    grid.describe(visitor);
  }
};

}  // namespace stereo_nav::nodes
