#include "odometry/stereo/stereo_params.h"

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {

void StereoParams::describe(ParameterVisitor& visitor) {
  visitor.integer("pyramid_levels", pyramid_levels, {1, 8}, "", "image sizes, each half the one before");
  visitSection(visitor, "corners", corners);
  visitSection(visitor, "tracking", tracking);
  visitSection(visitor, "stereo", stereo);
  visitSection(visitor, "rigidity", rigidity);
  clique.describe(visitor);
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "window", window);
  visitSection(visitor, "keyframes", keyframes);
  visitSection(visitor, "imu", imu);
  visitor.integer("min_inliers", min_inliers, {4, 1000}, "",
                  "a frame in which fewer features agree on one motion is lost");
  visitor.integer(
      "max_lost_frames", max_lost_frames, {0, 1000}, "",
      "consecutive lost frames after which the map is given up and a new one is begun; blank images "
      "do not count");
  visitor.real("coasting_s", coasting_s, {0.0, 60.0}, "s",
               "how long the pose goes on with the last velocity while no motion is measured; after that the "
               "position is held");
  motion_model.describe(visitor);
}

}  // namespace stereo_nav::odometry
