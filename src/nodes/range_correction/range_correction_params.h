#pragma once

#include <string>

#include "estimation/range_correction/range_params.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of the range_correction node: its own, and those of the correction.
struct RangeCorrectionParams {
  std::string map_frame = "map";
  std::string odom_frame = ros_io::frames::kOdom;
  std::string base_frame = ros_io::frames::kBase;
  std::string ranges = "front rear left right";
  bool publish_tf = true;
  double transform_tolerance_s = 0.2;
  double input_timeout_s = 3.0;
  double initial_x_m = 0.0;
  double initial_y_m = 0.0;
  double initial_yaw_rad = 0.0;
  double initial_sigma_m = 0.1;
  double initial_sigma_rad = 0.05;
  estimation::RangeParams correction;

  void describe(ParameterVisitor& visitor) {
    visitor.text("map_frame", map_frame, "frame of the map");
    visitor.text("odom_frame", odom_frame, "frame of the odometry, in which nothing jumps");
    visitor.text("base_frame", base_frame, "frame of the robot, on the floor");
    visitor.text("ranges", ranges,
                 "names NAME of the range finders range/NAME that are used, separated by blanks");
    visitor.flag("publish_tf", publish_tf, "publish map_frame -> odom_frame; off where another one does");
    visitor.real("transform_tolerance_s", transform_tolerance_s, {0.0, 10.0}, "s",
                 "added to the stamps in tf, so that the transform is there for what comes next");
    visitor.real("input_timeout_s", input_timeout_s, {0.1, 60.0}, "s",
                 "silence of all range finders before the node explains it");
    visitor.real("initial_x_m", initial_x_m, {-1e5, 1e5}, "m", "where the robot starts in the map");
    visitor.real("initial_y_m", initial_y_m, {-1e5, 1e5}, "m", "the same");
    visitor.real("initial_yaw_rad", initial_yaw_rad, {-6.3, 6.3}, "rad", "its heading there");
    visitor.real("initial_sigma_m", initial_sigma_m, {1e-3, 100.0}, "m", "how well that is known");
    visitor.real("initial_sigma_rad", initial_sigma_rad, {1e-3, 3.2}, "rad", "the same of the heading");
    correction.describe(visitor);
  }
};

}  // namespace stereo_nav::nodes
