#include "navigation/obstacles/obstacle_params.h"

namespace stereo_nav::navigation {

void ObstacleParams::describe(ParameterVisitor& visitor) {
  visitor.real("size_m", size_m, {1.0, 50.0}, "m",
               "side of the square around the robot that the grid covers");
  visitor.real("resolution_m", resolution_m, {0.01, 0.5}, "m", "side of a cell");
  visitor.real("range_max_m", range_max_m, {0.5, 20.0}, "m",
               "what is farther away is not taken from the disparity");
  visitor.real("min_height_m", min_height_m, {0.01, 1.0}, "m",
               "what rises less above the floor is driven over");
  visitor.real("max_height_m", max_height_m, {0.1, 5.0}, "m", "what hangs higher is driven under");
  visitor.real("hole_depth_m", hole_depth_m, {0.01, 1.0}, "m", "what lies deeper below the floor is a hole");
  visitor.real("disparity_sigma_px", disparity_sigma_px, {0.05, 5.0}, "px",
               "deviation of one pixel's disparity");
  visitor.real(
      "max_tilt_deg", max_tilt_deg, {0.0, 10.0}, "deg",
      "the floor may be tilted so far against the mounting of the camera and is then estimated; 0: the mounting is believed");
  visitor.integer("column_px", column_px, {1, 16}, "px", "columns of the image that are looked at together");
  visitor.real("memory_s", memory_s, {0.5, 600.0}, "s",
               "a cell that no sensor has looked at for this long is unknown again");
  visitor.real(
      "near_m", near_m, {0.0, 10.0}, "m",
      "nearer to the robot than this, where cameras may not see what they saw before, near_memory_s counts");
  visitor.real("near_memory_s", near_memory_s, {0.0, 3600.0}, "s",
               "the same, near the robot, if it is longer");
}

}  // namespace stereo_nav::navigation
