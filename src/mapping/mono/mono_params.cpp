#include "mapping/mono/mono_params.h"

namespace stereo_nav::mapping {

void MotionNoise::describe(ParameterVisitor& visitor) {
  visitor.real("acceleration_sigma", acceleration_sigma, {1e-4, 100.0}, "m/s",
               "what the speed changes by within 1 s; units of the map where its scale is unknown");
  visitor.real("turn_acceleration_sigma", turn_acceleration_sigma, {1e-4, 100.0}, "rad/s",
               "what the rate of turn changes by within 1 s; not used where a gyroscope measures it");
}

void MeasuredMotionParams::describe(ParameterVisitor& visitor) {
  visitor.real("gyro_sigma_rad_per_s", gyro_sigma_rad_per_s, {1e-4, 10.0}, "rad/s",
               "standard deviation of the mean rate of turn between two frames by the IMU, with its bias");
  visitor.real("speed_sigma_m_per_s", speed_sigma_m_per_s, {1e-4, 10.0}, "m/s",
               "standard deviation of the velocity by wheels or another odometry at rest");
  visitor.real("speed_sigma_share", speed_sigma_share, {0.0, 1.0}, "",
               "what it grows by with the speed, a share of it");
}

void PatchSearchParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window_px", window_px, {7, 21}, "px", "side of a patch, odd");
  visitor.real("min_correlation", min_correlation, {0.0, 1.0}, "",
               "zero-mean normalised correlation from which a patch counts as found");
  visitor.real(
      "min_texture", min_texture, {0.0, 1000.0}, "",
      "least texture of a patch: smaller eigenvalue of its gradient moments, (grey levels per px)^2");
  visitor.real("most_search_px", most_search_px, {2.0, 200.0}, "px",
               "half axes of the ellipse that is searched are at most this long");
}

void OnePointRansacParams::describe(ParameterVisitor& visitor) {
  visitor.real("threshold_px", threshold_px, {0.1, 20.0}, "px",
               "a match agrees with a hypothesis that predicts it within this");
  visitor.real("probability", probability, {0.5, 0.9999}, "",
               "with which one hypothesis at least comes from a right match");
  visitor.real(
      "chi_square", chi_square, {1.0, 30.0}, "",
      "a match that was rejected comes back when its innovation, after the correction by the others, is "
      "within this");
  visitor.integer("most_hypotheses", most_hypotheses, {1, 1000}, "", "budget of hypotheses a frame");
}

void MonoParams::describe(ParameterVisitor& visitor) {
  visitor.real("pixel_sigma_px", pixel_sigma_px, {0.05, 5.0}, "px", "standard deviation of a found patch");
  visitor.real(
      "start_speed_sigma", start_speed_sigma, {0.0, 100.0}, "m/s",
      "standard deviation of the speed at the first frame, which is taken to be 0; units of the map where "
      "its scale is unknown");
  visitor.real("start_turn_sigma_rad_per_s", start_turn_sigma_rad_per_s, {0.0, 100.0}, "rad/s",
               "likewise of the rate of turn");
  visitor.real(
      "inverse_depth_start", inverse_depth_start, {1e-3, 100.0}, "1/m",
      "inverse depth at which a new landmark starts; where the scale is unknown, it sets the unit of the map");
  visitor.real("inverse_depth_sigma", inverse_depth_sigma, {1e-3, 100.0}, "1/m", "its standard deviation");
  visitor.real("linearity_index", linearity_index, {0.0, 1.0}, "",
               "a landmark whose depth is as Gaussian as this is kept as a point (Civera et al. 2008)");
  visitor.integer("most_landmarks", most_landmarks, {8, 200}, "",
                  "that the map holds; those unseen for the longest time leave it");
  visitor.integer("most_measured", most_measured, {8, 200}, "", "landmarks that are searched for in a frame");
  visitor.real("least_found_share", least_found_share, {0.0, 1.0}, "",
               "a landmark that is found in a smaller share of the frames that should see it leaves the map");
  visitor.integer(
      "fast_threshold", fast_threshold, {5, 100}, "",
      "t of FAST (9 contiguous pixels of a circle of radius 3 brighter or darker by t); lowered to a "
      "quarter in cells without corners");
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "measured", measured);
  visitSection(visitor, "search", search);
  visitSection(visitor, "ransac", ransac);
}

}  // namespace stereo_nav::mapping
