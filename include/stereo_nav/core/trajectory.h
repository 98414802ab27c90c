#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace stereo_nav {

/// Pose of a body at an instant; takes coordinates of the body frame into a fixed world frame.
struct StampedPose {
  double time_s = 0.0;                                             ///< seconds since any fixed moment
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();  ///< pose of the body in the world
};

/// In order of time, no stamp twice. std::vector needs no aligned allocator in C++17.
using Trajectory = std::vector<StampedPose>;

/// TUM format: one pose a line, `t tx ty tz qx qy qz qw` (s, m, unit quaternion), `#` starts a comment. Reads
/// any white space between the numbers and both kinds of line ends; normalises the quaternion. Throws
/// InputError with `file:line:` for anything else, for stamps that do not increase and for an empty
/// file.
Trajectory readTum(const std::string& path);

/// KITTI odometry format: one pose a line, the upper three rows of the 4x4 matrix, row by row. It has no
/// stamps: `times_s` gives them, one per line (readKittiTimes()). Throws InputError as readTum() does,
/// and when the numbers of poses and stamps differ.
Trajectory readKitti(const std::string& path, const std::vector<double>& times_s);

/// `times.txt` of a KITTI sequence: one stamp in seconds a line. Throws InputError.
std::vector<double> readKittiTimes(const std::string& path);

/// Text of a file in either format: nanoseconds and nanometres, quaternions with qw >= 0. Write it with
/// writeFileAtomically().
std::string toTum(const Trajectory& trajectory);
std::string toKitti(const Trajectory& trajectory);

/// The same motion told of another point of the same rigid body: T_world_other = T_world_body * T_body_other.
Trajectory ofOtherBody(const Trajectory& trajectory, const Eigen::Isometry3d& T_body_other);

/// Length of the path through all positions, m.
double pathLength(const Trajectory& trajectory);

}  // namespace stereo_nav
