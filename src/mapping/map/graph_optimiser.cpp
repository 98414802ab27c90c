#include "mapping/map/graph_optimiser.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mapping/map/chordal_start.h"
#include "mapping/map/edge_error.h"
#include "mapping/map/pose_block.h"

namespace stereo_nav::mapping {
namespace {

/// Steps begin as those of Gauss and Newton and are shortened where they fail: pose graphs are nearly linear
/// once rotations are right, and Ceres' own 1e4 takes three times as many.
constexpr double kFirstRadius = 1e12;

/// Error and derivatives of one edge, times the root of its information.
template <class Pose>
class EdgeCost
    : public ceres::SizedCostFunction<Motion<Pose>::kDof, PoseBlock<Pose>::kSize, PoseBlock<Pose>::kSize> {
  static constexpr int kDof = Motion<Pose>::kDof;

 public:
  EdgeCost(const GraphEdge<Pose>& edge, double weight)
      : edge_(edge), root_(std::sqrt(weight) * edge.information.llt().matrixU().toDenseMatrix()) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Pose T_map_from = PoseBlock<Pose>::read(blocks[0]), T_map_to = PoseBlock<Pose>::read(blocks[1]);
    Eigen::Map<typename Motion<Pose>::Vector>{residuals} = root_ * edgeError(edge_, T_map_from, T_map_to);
    if (jacobians == nullptr) return true;
    const EdgeJacobians<Pose> J = edgeJacobians(edge_, T_map_from, T_map_to);
    if (jacobians[0] != nullptr) write(root_ * J.from, jacobians[0]);
    if (jacobians[1] != nullptr) write(root_ * J.to, jacobians[1]);
    return true;
  }

 private:
  static void write(const typename Motion<Pose>::Matrix& derivatives, double* jacobian) {
    Eigen::Map<Eigen::Matrix<double, kDof, PoseBlock<Pose>::kSize, Eigen::RowMajor>> J(jacobian);
    J.template leftCols<kDof>() = derivatives;
    J.template rightCols<PoseBlock<Pose>::kSize - kDof>().setZero();
  }

  const GraphEdge<Pose>& edge_;
  typename Motion<Pose>::Matrix root_;
};

template <class Pose>
using Blocks = std::vector<std::array<double, PoseBlock<Pose>::kSize>>;

template <class Pose>
void addBlocks(const PoseGraph<Pose>& graph, const std::vector<double>& weights, Blocks<Pose>& blocks,
               ceres::Problem& problem) {
  const std::vector<bool> anchors = anchorsOf(graph, weights);
  for (std::size_t v = 0; v < blocks.size(); ++v) {
    PoseBlock<Pose>::write(graph.poses[v], blocks[v].data());
    problem.AddParameterBlock(blocks[v].data(), PoseBlock<Pose>::kSize);
    if (anchors[v]) problem.SetParameterBlockConstant(blocks[v].data());
  }
}

/// Poses in the plane move as their three numbers do.
void setMotion(std::vector<std::array<double, 3>>& /*blocks*/, ceres::Problem& /*problem*/) {}

void setMotion(std::vector<std::array<double, 7>>& blocks, ceres::Problem& problem) {
  auto* motion = new SpatialMotion;  // the problem owns it
  for (auto& block : blocks) {
#if CERES_VERSION_MAJOR * 100 + CERES_VERSION_MINOR >= 201
    problem.SetManifold(block.data(), motion);
#else
    problem.SetParameterization(block.data(), motion);
#endif
  }
}

template <class Pose>
void addEdges(const PoseGraph<Pose>& graph, const EdgeUse& use, Blocks<Pose>& blocks,
              ceres::Problem& problem) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge<Pose>& edge = graph.edges[e];
    const double weight = use.weights.empty() ? 1.0 : use.weights[e];
    if (weight <= 0.0) continue;
    const bool robust = !use.robust.empty() && use.robust[e];
    problem.AddResidualBlock(new EdgeCost<Pose>(edge, weight),
                             robust ? new ceres::CauchyLoss(use.cauchy_chi) : nullptr,
                             blocks[edge.from].data(), blocks[edge.to].data());
  }
}

ceres::Solver::Options optionsOf(const OptimiserParams& params) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = params.max_iterations;
  options.function_tolerance = params.tolerance;
  options.num_threads = 1;
  options.initial_trust_region_radius = kFirstRadius;
  options.logging_type = ceres::SILENT;
  return options;
}

template <class Pose>
std::size_t degreesOfFreedom(const PoseGraph<Pose>& graph) {
  return Motion<Pose>::kDof * std::max(graph.edges.size(), graph.poses.size()) -
         Motion<Pose>::kDof * (graph.poses.size() - std::min<std::size_t>(1, graph.poses.size()));
}

/// What is made least: chi-square, with Cauchy's loss where edges are robust.
template <class Pose>
double costOf(const PoseGraph<Pose>& graph, const EdgeUse& use) {
  const double scale = use.cauchy_chi * use.cauchy_chi;
  double cost = 0.0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double chi_square = (use.weights.empty() ? 1.0 : use.weights[e]) * chiSquare(graph, graph.edges[e]);
    const bool robust = !use.robust.empty() && use.robust[e];
    cost += robust ? scale * std::log1p(chi_square / scale) : chi_square;
  }
  return cost;
}

/// Replaces a bad start by the chordal one where that is better.
template <class Pose>
bool improveStart(PoseGraph<Pose>& graph, const OptimiserParams& params, const EdgeUse& use) {
  const double given = costOf(graph, use);
  if (given <= params.bad_start * static_cast<double>(degreesOfFreedom(graph))) return false;
  auto poses = chordalStart(graph, use.weights);
  poses.swap(graph.poses);
  if (costOf(graph, use) < given) return true;
  poses.swap(graph.poses);
  return false;
}

}  // namespace

void OptimiserParams::describe(ParameterVisitor& visitor) {
  visitor.integer("max_iterations", max_iterations, {1, 10000}, "", "steps of Levenberg-Marquardt at most");
  visitor.real("tolerance", tolerance, {1e-12, 1e-2}, "",
               "the optimum is reached when a step lowers chi-square by less than this share");
  visitor.real(
      "bad_start", bad_start, {0.0, 1e9}, "",
      "a start whose chi-square is above this many times the degrees of freedom is compared with a chordal one");
}

template <class Pose>
OptimiserResult optimise(PoseGraph<Pose>& graph, const OptimiserParams& params, const EdgeUse& use) {
  OptimiserResult result;
  result.chi_square_before = chiSquare(graph, use.weights);
  result.chordal = improveStart(graph, params, use);
  ceres::Problem problem;
  Blocks<Pose> blocks(graph.poses.size());
  addBlocks(graph, use.weights, blocks, problem);
  setMotion(blocks, problem);
  addEdges(graph, use, blocks, problem);
  ceres::Solver::Summary summary;
  if (problem.NumResidualBlocks() > 0) ceres::Solve(optionsOf(params), &problem, &summary);
  for (std::size_t v = 0; v < blocks.size(); ++v) graph.poses[v] = PoseBlock<Pose>::read(blocks[v].data());
  result.chi_square_after = chiSquare(graph, use.weights);
  result.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  result.converged = problem.NumResidualBlocks() == 0 || summary.termination_type == ceres::CONVERGENCE;
  return result;
}

template OptimiserResult optimise(PlanarGraph&, const OptimiserParams&, const EdgeUse&);
template OptimiserResult optimise(SpatialGraph&, const OptimiserParams&, const EdgeUse&);

}  // namespace stereo_nav::mapping
