#include "mapping/map/robust_optimiser.h"

#include <fmt/format.h>

#include <cmath>

#include "core/statistics.h"
#include "mapping/map/edge_error.h"

namespace stereo_nav::mapping {
namespace {

/// The control parameter of the graduation: at the first value loops of up to ten times the gate count, the
/// last is all or nothing to a hundredth.
constexpr double kFirstControl = 1.0 / 9.0, kLastControl = 100.0, kControlFactor = 1.6;

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
    for (const std::size_t e : consistency_.loops) use_.weights[e] = 0.0;
    setWeights(consistency_.sets.front(), 1.0);
    EdgeUse use = use_;
    use.cauchy_chi = params_.cauchy_chi;
    use.robust = loopsOf(graph_);
    optimise(graph_, params_.optimiser, use);
    chi_square_ = optimise(graph_, params_.optimiser, use_).chi_square_after;
  }

  /// Loops that agree with each other are taken when chi-square rises by less than the gate for each of them:
  /// that lowers the cost of truncated least squares, in which a rejected loop costs the gate.
  void tryToJoin(const std::vector<std::size_t>& set) {
    PoseGraph<Pose> joined = graph_;
    setWeights(set, 1.0);
    const double chi_square = optimise(joined, params_.optimiser, use_).chi_square_after;
    if (chi_square - chi_square_ < gate_ * static_cast<double>(set.size())) {
      graph_.poses = joined.poses;
      chi_square_ = chi_square;
    } else {
      setWeights(set, 0.0);
    }
  }

  void setWeights(const std::vector<std::size_t>& set, double weight) {
    for (const std::size_t i : set) use_.weights[consistency_.loops[i]] = weight;
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
  double gate_, chi_square_ = 0.0;
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
