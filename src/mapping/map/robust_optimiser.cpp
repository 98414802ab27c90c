#include "mapping/map/robust_optimiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics.h"
#include "mapping/map/edge_error.h"

namespace stereo_nav::mapping {
namespace {

/// The control parameter of the graduation: at the first value loops of up to ten times the gate count, the
/// last is all or nothing to a hundredth.
constexpr double kFirstControl = 1.0 / 9.0, kLastControl = 100.0, kControlFactor = 1.6;

/// A set of true loops needs fewer steps to join; one of false loops would go on for long.
constexpr int kJoinIterations = 10;

/// Weight of a loop under truncated least squares, softened by the control parameter.
double softWeight(double chi_square, double gate, double control) {
  if (chi_square <= control / (control + 1.0) * gate) return 1.0;
  if (chi_square >= (control + 1.0) / control * gate) return 0.0;
  return std::sqrt(gate * control * (control + 1.0) / chi_square) - control;
}

template <class Pose>
class RobustOptimiser {
 public:
  RobustOptimiser(PoseGraph<Pose>& graph, const RobustParams& params)
      : graph_(graph),
        params_(params),
        gate_(chiSquareQuantile(Motion<Pose>::kDof, params.confidence)),
        is_loop_(loopsOf(graph)),
        consistency_(consistentLoops(graph, params.consistency)) {
    use_.weights.assign(graph.edges.size(), 1.0);
  }

  RobustResult run() {
    if (!consistency_.sets.empty()) beginWithTheLargestSet();
    for (std::size_t s = 1; s < consistency_.sets.size(); ++s) tryToJoin(consistency_.sets[s]);
    for (double control = kFirstControl; control < kLastControl; control *= kControlFactor) {
      weighLoops([&](double chi_square) { return softWeight(chi_square, gate_, control); });
      optimise(graph_, params_.optimiser, use_);
    }
    weighLoops([&](double chi_square) { return chi_square <= gate_ ? 1.0 : 0.0; });
    RobustResult result;
    result.optimiser = optimise(graph_, params_.optimiser, use_);
    result.consistent = consistency_.sets.empty() ? 0 : consistency_.sets.front().size();
    result.largest = consistency_.largest;
    for (std::size_t i = 0; i < consistency_.loops.size(); ++i) result.loops.push_back(verdict(i));
    return result;
  }

 private:
  void beginWithTheLargestSet() {
    setWeights(consistency_.loops, 0.0);
    setWeights(edgesOf(consistency_.sets.front()), 1.0);
    optimiseRobustly(graph_, params_.optimiser);
    cost_ = truncatedCost(graph_);
  }

  void tryToJoin(const std::vector<std::size_t>& set) {
    PoseGraph<Pose> joined = graph_;
    setWeights(edgesOf(set), 1.0);
    OptimiserParams params = params_.optimiser;
    params.max_iterations = std::min(params.max_iterations, kJoinIterations);
    optimiseRobustly(joined, params);
    const double cost = truncatedCost(joined);
    if (cost < cost_) {
      graph_.poses = std::move(joined.poses);
      cost_ = cost;
    } else {
      setWeights(edgesOf(set), 0.0);
    }
  }

  void optimiseRobustly(PoseGraph<Pose>& graph, const OptimiserParams& params) const {
    EdgeUse use = use_;
    use.cauchy_chi = params_.cauchy_chi;
    use.robust = is_loop_;
    optimise(graph, params, use);
  }

  /// The cost of truncated least squares: a loop costs its chi-square, or the gate for being rejected.
  double truncatedCost(const PoseGraph<Pose>& graph) const {
    double cost = 0.0;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const double chi_square = chiSquare(graph, graph.edges[e]);
      cost += is_loop_[e] ? std::min(chi_square, gate_) : chi_square;
    }
    return cost;
  }

  std::vector<std::size_t> edgesOf(const std::vector<std::size_t>& set) const {
    std::vector<std::size_t> edges;
    for (const std::size_t i : set) edges.push_back(consistency_.loops[i]);
    return edges;
  }
  void setWeights(const std::vector<std::size_t>& edges, double weight) {
    for (const std::size_t e : edges) use_.weights[e] = weight;
  }

  template <class Weight>
  void weighLoops(const Weight& weight) {
    for (const std::size_t e : consistency_.loops)
      use_.weights[e] = weight(chiSquare(graph_, graph_.edges[e]));
  }

  LoopVerdict verdict(std::size_t i) const {
    LoopVerdict verdict;
    verdict.edge = consistency_.loops[i];
    verdict.kept = use_.weights[verdict.edge] > 0.0;
    verdict.chi_square = chiSquare(graph_, graph_.edges[verdict.edge]);
    verdict.agrees = consistency_.agrees[i];
    if (!verdict.kept)
      verdict.reason = fmt::format(
          "chi-square {:.4g} against the map, at most {:.4g} for {:.4g} % of true loops; agrees with {} of the {} loops of the largest consistent set",
          verdict.chi_square, gate_, 100.0 * params_.confidence, verdict.agrees,
          consistency_.sets.front().size());
    return verdict;
  }

  PoseGraph<Pose>& graph_;
  const RobustParams& params_;
  double gate_, cost_ = 0.0;
  std::vector<bool> is_loop_;
  ConsistentLoops consistency_;
  EdgeUse use_;
};

}  // namespace

void RobustParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "optimiser", optimiser);
  visitSection(visitor, "consistency", consistency);
  visitor.real("cauchy_chi", cauchy_chi, {0.1, 100.0}, "",
               "standard deviations at which Cauchy's loss of the consistent loops begins");
  visitor.real("confidence", confidence, {0.5, 0.999999}, "",
               "probability with which a true loop is to fit the map");
}

template <class Pose>
RobustResult optimiseRobustly(PoseGraph<Pose>& graph, const RobustParams& params) {
  return RobustOptimiser<Pose>(graph, params).run();
}

template RobustResult optimiseRobustly(PlanarGraph&, const RobustParams&);
template RobustResult optimiseRobustly(SpatialGraph&, const RobustParams&);

}  // namespace stereo_nav::mapping
