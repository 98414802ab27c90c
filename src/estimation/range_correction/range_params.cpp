#include "estimation/range_correction/range_params.h"

namespace stereo_nav::estimation {

void RangeParams::describe(ParameterVisitor& visitor) {
  visitor.integer("readings", readings, {1, 100}, "",
                  "readings of a range finder whose mean is one measurement");
  visitor.real("window_s", window_s, {0.01, 60.0}, "s", "readings older than this are not among them");
  visitor.real(
      "min_way_m", min_way_m, {0.0, 10.0}, "m",
      "way, or turn, of the robot between two measurements of a range finder: at rest it says the same again");
  visitor.real("min_turn_rad", min_turn_rad, {0.0, 3.2}, "rad", "the turn");
  visitor.real("reading_sigma_m", reading_sigma_m, {1e-4, 1.0}, "m", "noise of a single reading");
  visitor.real("bias_sigma_m", bias_sigma_m, {1e-4, 1.0}, "m",
               "how far a range finder is wrong by always the same, which is estimated");
  visitor.real("bias_walk_m", bias_walk_m, {0.0, 1.0}, "m", "how far that changes in a second");
  visitor.real("wall_sigma_m", wall_sigma_m, {1e-4, 1.0}, "m",
               "how far the walls of the map are from where they are");
  visitor.real("foreign_share", foreign_share, {1e-6, 0.9}, "",
               "share of beams that meet what the map does not have: people, doors, boxes");
  visitor.real("way_noise_m", way_noise_m, {1e-4, 1.0}, "m", "error of the odometry after a way of 1 m");
  visitor.real("turn_noise_rad", turn_noise_rad, {1e-4, 1.0}, "rad",
               "error of its heading after 1 m or 1 rad");
}

}  // namespace stereo_nav::estimation
