#pragma once

#include <vector>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

/// What an odometry knows of a pose, as indices into x, y, z and the rotations about them.
struct KnownAxes {
  std::vector<Eigen::Index> all, translation, rotation;
};
KnownAxes knownAxes(bool planar);

/// Consistency of the covariances with the errors over pieces of `interval_s`, one after the other: from each
/// piece the error of the relative pose, e = log(estimate^-1 truth), and the covariance P of `input`, with
/// the truth's own noise at both ends added, give the normalised estimation error squared e^T P^-1 e
/// (Bar-Shalom, Li and Kirubarajan 2001, section 5.4.2). Pieces whose ends have no pose, or no ground truth,
/// are left out.
Nees neesOver(double interval_s, const EvaluationInput& input);

}  // namespace stereo_nav::eval
