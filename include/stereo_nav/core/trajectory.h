#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace stereo_nav {

/// Pose of a body at an instant. It takes coordinates of the body frame into a fixed world frame.
struct StampedPose {
  double time_s = 0.0;                                             ///< seconds since some fixed moment
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();  ///< pose of the body in the world
};

/// Poses in order of time; no stamp occurs twice. std::vector needs no aligned allocator in C++17.
using Trajectory = std::vector<StampedPose>;

/// Reads the TUM format: one pose per line, `t tx ty tz qx qy qz qw` (s, m, unit quaternion); `#` starts a
/// comment. Accepts any white space between the numbers and both kinds of line ends; normalises the
/// quaternion. Throws InputError with `file:line:` for anything else, for stamps that do not increase and for
/// an empty file.
Trajectory readTum(const std::string& path);

/// Reads the KITTI odometry format: one pose per line, the upper three rows of the 4x4 matrix, row by row.
/// The format has no stamps: `times_s` gives one per line (readKittiTimes()). Throws InputError as readTum()
/// does, and when the numbers of poses and stamps differ.
Trajectory readKitti(const std::string& path, const std::vector<double>& times_s);

/// Reads `times.txt` of a KITTI sequence: one stamp in seconds per line. Throws InputError as readTum() does.
std::vector<double> readKittiTimes(const std::string& path);

/// Returns the text of a file in the TUM format, with times to nanoseconds, positions to nanometres and
/// quaternions with qw >= 0. Write it with writeFileAtomically().
std::string toTum(const Trajectory& trajectory);
/// The same in the KITTI format.
std::string toKitti(const Trajectory& trajectory);

/// Returns the same motion for another frame of the same rigid body: T_world_other = T_world_body *
/// T_body_other.
Trajectory ofOtherBody(const Trajectory& trajectory, const Eigen::Isometry3d& T_body_other);

/// Length of the path through all positions, m.
double pathLength(const Trajectory& trajectory);
/// The same of positions in m.
double pathLength(const std::vector<Eigen::Vector3d>& positions_m);

}  // namespace stereo_nav
