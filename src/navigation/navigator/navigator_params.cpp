#include "navigation/navigator/navigator.h"

namespace stereo_nav::navigator {

void NavigatorParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "control", control);
  visitSection(visitor, "check", check);
  visitSection(visitor, "progress", progress);
  visitSection(visitor, "recovery", recovery);
  visitor.real("odometry_timeout_s", odometry_timeout_s, {0.05, 5.0}, "s",
               "it stops when the odometry is older");
  visitor.real("surroundings_timeout_s", surroundings_timeout_s, {0.05, 5.0}, "s",
               "it stops when the local grid is older");
  visitor.real("slow_above_sigma_m", slow_above_sigma_m, {0.0, 10.0}, "m",
               "deviation of the position above which it becomes slower");
  visitor.real("stop_above_sigma_m", stop_above_sigma_m, {0.01, 20.0}, "m",
               "deviation of the position above which it stops; above slow_above_sigma_m");
  visitor.real("blocked_patience_s", blocked_patience_s, {0.1, 60.0}, "s",
               "so long it waits for what is in its way");
  visitor.real("look_at_route_every_s", look_at_route_every_s, {0.05, 10.0}, "s",
               "between two looks whether the rest of the route is free");
  visitor.real("goal_tolerance_m", goal_tolerance_m, {0.005, 5.0}, "m",
               "a path that ends so near to the goal has reached it");
  visitor.real("jump_m", jump_m, {0.01, 10.0}, "m", "a larger jump of map to odom is planned anew after");
}

}  // namespace stereo_nav::navigator
