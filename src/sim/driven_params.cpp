#include "sim/driven_params.h"

namespace stereo_nav::sim {

void DrivenParams::describe(ParameterVisitor& visitor) {
  visitor.real("start_x_m", start_x_m, {-100.0, 100.0}, "m", "where a driven robot starts");
  visitor.real("start_y_m", start_y_m, {-100.0, 100.0}, "m", "where a driven robot starts");
  visitor.real("start_yaw_deg", start_yaw_deg, {-360.0, 360.0}, "deg", "heading at the start");
  visitor.real("longest_s", longest_s, {1.0, 86400.0}, "s", "no images are taken after this time");
  visitor.real("dead_time_s", dead_time_s, {0.0, 1.0}, "s", "from a command to the motors' answer");
  visitor.real("lag_s", lag_s, {1e-3, 5.0}, "s", "time constant of the wheels' speeds");
  visitor.real("max_acceleration_mps2", max_acceleration_mps2, {0.01, 100.0}, "m/s^2",
               "what motors and tyres can do; the base's own limits are those of the rig file");
  visitor.real("steering_lag_s", steering_lag_s, {1e-3, 5.0}, "s",
               "time constant of the steering axes' rates");
  visitor.real("length_m", length_m, {0.02, 10.0}, "m",
               "of the rectangle about base_link that touches things");
  visitor.real("width_m", width_m, {0.02, 10.0}, "m", "of that rectangle");
  visitor.real("height_m", height_m, {0.02, 10.0}, "m", "what begins above it is passed under");
  visitor.real("clearance_m", clearance_m, {0.0, 1.0}, "m", "what is lower is driven over");
}

void LaserModelParams::describe(ParameterVisitor& visitor) {
  visitor.real("rate_hz", rate_hz, {0.1, 100.0}, "Hz", "revolutions per second");
  visitor.real("noise_m", noise_m, {0.0, 1.0}, "m", "standard deviation of a range");
  visitor.real("noise_share", noise_share, {0.0, 1.0}, "",
               "standard deviation as a share of the range, where that is more");
  visitor.real("dropout", dropout, {0.0, 1.0}, "", "share of the beams that measure nothing");
}

void RangeModelParams::describe(ParameterVisitor& visitor) {
  visitor.real("rate_hz", rate_hz, {0.1, 1000.0}, "Hz", "measurements per second of each range finder");
  visitor.real("noise_m", noise_m, {0.0, 1.0}, "m", "standard deviation of a range");
}

}  // namespace stereo_nav::sim
