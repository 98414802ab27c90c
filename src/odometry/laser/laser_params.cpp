#include "odometry/laser/laser_params.h"

namespace stereo_nav::odometry {

void LaserParams::describe(ParameterVisitor& visitor) {
  visitEnum(
      visitor, "method", method,
      {{"scan_matching", LaserMethod::kScanMatching}, {"range_flow", LaserMethod::kRangeFlow}},
      "range_flow: for comparison, as rf2o's paper has it; takes no other parameter, neither wheels nor IMU");
  visitor.real("range_sigma_m", range_sigma_m, {1e-4, 1.0}, "m",
               "standard deviation of a range at distance 0");
  visitor.real("range_sigma_share", range_sigma_share, {0.0, 0.2}, "",
               "what it grows by with the range, a share of it");
  visitor.real(
      "wheel_slip_sigma", wheel_slip_sigma, {1e-4, 1.0}, "m",
      "standard deviation of the wheels' way on 1 m, besides their scale; grows with the root of the way");
  visitor.real("wheel_turn_sigma", wheel_turn_sigma, {1e-4, 1.0}, "rad",
               "standard deviation of the wheels' turn on 1 m or 1 rad; grows with its root");
  visitor.real(
      "wheel_scale_sigma", wheel_scale_sigma, {0.0, 1.0}, "",
      "relative standard deviation of the wheels' scale along each axis, before the laser has measured it");
  visitor.real("gyro_sigma_rad", gyro_sigma_rad, {1e-6, 1.0}, "rad",
               "standard deviation of the gyroscope's turn in 1 s; grows with the root of the time");
  visitor.real("gyro_bias_sigma_rad_per_s", gyro_bias_sigma_rad_per_s, {0.0, 1.0}, "rad/s",
               "standard deviation of the gyroscope's bias before the laser has measured it");
  visitor.real("acceleration_sigma_m_per_s2", acceleration_sigma_m_per_s2, {1e-3, 100.0}, "m/s",
               "what the speed changes by within 1 s, where no wheels tell it");
  visitor.real("turn_acceleration_sigma_rad_per_s2", turn_acceleration_sigma_rad_per_s2, {1e-3, 100.0},
               "rad/s",
               "what the rate of turn changes by within 1 s, where neither wheels nor gyroscope tell it");
  visitor.real("keyframe_distance_m", keyframe_distance_m, {0.01, 10.0}, "m",
               "way after which a scan is added to the map");
  visitor.real("keyframe_turn_deg", keyframe_turn_deg, {1.0, 180.0}, "deg", "the same of a turn");
  visitor.integer("keyframes", keyframes, {1, 1000}, "scans", "that the map holds; the oldest ones leave it");
  visitor.real("cell_m", cell_m, {0.02, 1.0}, "m",
               "cell of the map's finest level; each line is fitted over three by three cells");
  visitor.real("least_information_share", least_information_share, {0.0, 0.3}, "",
               "a direction is told when the walls across it hold this share of the scan's information");
  visitor.real("least_inlier_share", least_inlier_share, {0.05, 0.95}, "",
               "share of a scan's points that must lie on the map for it to be believed");
}

}  // namespace stereo_nav::odometry
