#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "navigation/control/follower.h"
#include "navigation/control/path.h"

namespace stereo_nav::control {

/// What a follower did on a course, on the simulated drive.
struct CourseRun {
  struct Sample {
    double time_s;
    DriveState state;
    double left_m;  ///< distance of the reference point from the path, positive to its left
  };
  std::vector<Sample> samples;  ///< each quarter of a period, up to the end
  double worst_m = 0.0;         ///< largest distance from the path
  double rms_m = 0.0;
  double end_distance_m = 0.0;  ///< of the reference point from the last point, where the base stands at last
  double end_heading_error_rad = 0.0;
  double duration_s = 0.0;     ///< from rest until the base stands
  double median_step_s = 0.0;  ///< time that one command took to compute
  bool finished = false;       ///< false: given up after most_s
};

/// How a course is driven.
struct CourseOptions {
  DriveModelParams drive;    ///< of the simulated drive; that of a follower may differ
  double reference_m = 0.0;  ///< the point that is to follow the path, so far ahead of base_link
  double period_s = 0.02;
  double most_s = 60.0;
  double odometry_age_s = 0.0;  ///< what the follower gets is so old, as its stamp says
  double position_noise_m = 0.0, heading_noise_rad = 0.0;  ///< of what it gets, each period anew
  /// Ends where the reference point comes within 3 cm of the last point or passes it, for the published
  /// followers, which do not brake; otherwise once the follower has finished and the base stands.
  bool until_near_end = false;
};

/// Drives from rest; the reference point starts on the path's first point, the base with the path's heading.
CourseRun driveCourse(const Path& path, Follower& follower, const CourseOptions& options);

}  // namespace stereo_nav::control
