// The parameters of StereoOdometry.
#include "odometry/stereo/stereo_odometry.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {

void KeyframeParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window", window, {2, 50}, "", "keyframes refined together");
  visitor.real("min_tracked_share", min_tracked_share, {0.0, 1.0}, "",
               "a frame with a smaller share of the last keyframe's inliers becomes a keyframe");
  visitor.real(
      "max_parallax_px", max_parallax_px, {0.1, 1000.0}, "px",
      "features move this far from one keyframe to the next (median); the frame becomes one after which "
      "the next would be beyond, should it move on as this one did");
}

void StereoParams::describe(ParameterVisitor& visitor) {
  visitor.integer("pyramid_levels", pyramid_levels, {1, 8}, "", "image sizes, each half the one before");
  visitSection(visitor, "corners", corners);
  visitSection(visitor, "tracking", tracking);
  visitSection(visitor, "stereo", stereo);
  visitSection(visitor, "rigidity", rigidity);
  visitor.integer(
      "clique_points", clique_points, {10, 5000}, "",
      "most features among which the largest rigid set is searched; the work grows with its square");
  visitor.integer("clique_budget", clique_budget, {0, 10000000}, "",
                  "most nodes expanded in search of the largest rigid set");
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "window", window);
  visitSection(visitor, "keyframes", keyframes);
  visitSection(visitor, "imu", imu);
  visitor.integer("min_inliers", min_inliers, {4, 1000}, "",
                  "fewer features that agree are no motion: the frame is lost");
  visitor.integer("max_coasting_frames", max_coasting_frames, {0, 1000}, "",
                  "lost frames after which the map is given up and a new one begun");
  visitor.real("acceleration_density", acceleration_density, {1e-6, 1e6}, "m^2/s^3",
               "how much the velocity changes: its variance grows by this per second");
  visitor.real("angular_acceleration_density", angular_acceleration_density, {1e-6, 1e6}, "rad^2/s^3",
               "how much the angular rate changes: its variance grows by this per second");
}

}  // namespace stereo_nav::odometry
