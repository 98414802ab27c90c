#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

using Poses = std::vector<Eigen::Isometry3d>;

/// Root mean square of the distances between two lists of positions of equal, nonzero length, m. With the
/// estimate aligned first (alignRigidly()) this is the absolute trajectory error.
double rmse(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b);

/// The lengths among 0.5, 1, 2, 5, 10, 20, 50, 100 and 200 m that lie between 1/12 and 1/2 of the length of
/// the path.
std::vector<double> segmentLengths(double path_length_m);

/// Error of the motion over pieces of given lengths, as in the KITTI odometry benchmark, but from every
/// frame.
struct RelativeError {
  double translation_percent;     ///< NaN when no piece fits into the path
  double rotation_deg_per_m;      ///< NaN when no piece fits into the path
  std::vector<double> lengths_m;  ///< the lengths asked for
};

/// For every frame i and every length L: j = the first frame whose ground-truth path from i is at least L;
/// the error of the relative pose from i to j, its translation as a percentage of L, its rotation as degrees
/// per metre of L; mean over all (i, L). Frame by frame, both lists in their own fixed frames (no alignment
/// is needed).
RelativeError relativeError(const Poses& ground_truth, const Poses& estimate,
                            const std::vector<double>& lengths_m);

/// The same over pieces of one length along `way_m`, how far the body had come at each pose: a piece from
/// pose i ends at the first one that is `length_m` further.
SegmentErrors segmentErrors(const Poses& ground_truth, const Poses& estimate,
                            const std::vector<double>& way_m, double length_m);

/// Way from the first pose to each pose, m.
std::vector<double> wayTo(const Poses& poses);

/// Number of steps from one pose to the next whose motion is more than 0.3 m or 10 degrees off.
std::size_t stepsOff(const Poses& ground_truth, const Poses& estimate);

/// Angle of a rotation, degrees, 0 to 180; exact for small angles, too.
double angleDeg(const Eigen::Matrix3d& R);

}  // namespace stereo_nav::eval
