#pragma once

#include <vector>

#include "mapping/map/pose_graph.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::mapping {

/// How a pose graph is optimised.
struct OptimiserParams {
  int max_iterations = 100;
  /// The optimum is reached when a step lowers chi-square by less than this share.
  double tolerance = 1e-6;
  /// A start whose chi-square is above this many times the graph's degrees of freedom is bad: a chordal one
  /// is computed and the better of the two taken.
  double bad_start = 100.0;

  void describe(ParameterVisitor& visitor);
};

struct OptimiserResult {
  double chi_square_before = 0.0, chi_square_after = 0.0;  ///< without the loss of robust edges
  int iterations = 0;                                      ///< steps that were tried
  bool converged = false;                                  ///< else max_iterations were not enough
  bool chordal = false;                                    ///< whether it began from the chordal start
};

/// Which edges count, and how.
struct EdgeUse {
  std::vector<double> weights;  ///< factor of the information; 0: left out. Empty: 1 each
  std::vector<bool> robust;     ///< Cauchy's loss instead of squares. Empty: none
  double cauchy_chi = 0.0;      ///< where that loss begins, in units of the weighed error
};

/// The poses at which chi-square is least, by Levenberg-Marquardt in Ceres with analytic derivatives and a
/// sparse Cholesky factorisation (Grisetti et al. 2010, "A tutorial on graph-based SLAM"). The first vertex
/// of each connected part keeps its pose. One thread: the same graph gives the same poses.
template <class Pose>
OptimiserResult optimise(PoseGraph<Pose>& graph, const OptimiserParams& params, const EdgeUse& use = {});

}  // namespace stereo_nav::mapping
