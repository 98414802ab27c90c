#include "mapping/map/mutual_consistency.h"

#include <algorithm>
#include <numeric>

#include "core/statistics.h"
#include "odometry/common/exact_clique.h"

namespace stereo_nav::mapping {
namespace {

/// Covariance of an edge as that of a small motion (m, rad) in the frame of its end.
template <class Pose>
typename Motion<Pose>::Matrix covarianceOf(const GraphEdge<Pose>& edge) {
  constexpr int kDof = Motion<Pose>::kDof;
  typename Motion<Pose>::Matrix covariance = edge.information.inverse();
  if constexpr (kDof == 6) {  // the vector part of a quaternion is half the angle
    covariance.template bottomRows<3>() *= 2.0;
    covariance.template rightCols<3>() *= 2.0;
  }
  return covariance;
}

/// Variance of a motion of which nothing is known, m^2 and rad^2.
constexpr double kUnknown = 1e4;

/// The odometry's poses by dead reckoning, and what their uncertainty adds up to.
template <class Pose>
class DeadReckoning {
  using Matrix = typename Motion<Pose>::Matrix;

 public:
  explicit DeadReckoning(const PoseGraph<Pose>& graph) {
    const auto odometry = odometryOf(graph);
    poses_.push_back(graph.poses.front());
    sums_.push_back(Matrix::Zero());
    for (std::size_t v = 0; v + 1 < graph.poses.size(); ++v) {
      if (odometry[v] == graph.edges.size()) {
        poses_.push_back(poses_.back() * graph.poses[v].inverse() * graph.poses[v + 1]);
        sums_.push_back(sums_.back() + kUnknown * Matrix::Identity());
        continue;
      }
      const GraphEdge<Pose>& edge = graph.edges[odometry[v]];
      const bool forward = edge.from == v;
      poses_.push_back(poses_.back() * (forward ? edge.T_from_to : edge.T_from_to.inverse()));
      const Matrix to_map = Motion<Pose>::adjoint(forward ? poses_[v + 1] : poses_[v]);
      sums_.push_back(sums_.back() + to_map * covarianceOf(edge) * to_map.transpose());
    }
  }
  const Pose& pose(std::size_t v) const { return poses_[v]; }
  /// Covariance of the motion between two vertices, of a small motion along the axes of the map.
  Matrix between(std::size_t a, std::size_t b) const {
    return a < b ? sums_[b] - sums_[a] : sums_[a] - sums_[b];
  }

 private:
  std::vector<Pose> poses_;
  std::vector<Matrix> sums_;
};

/// A loop as what it moves the map by, C = T_map_to T_from_to^-1 T_map_from^-1 with the odometry's poses: the
/// same for all loops that agree.
template <class Pose>
struct Loop {
  using Matrix = typename Motion<Pose>::Matrix;
  std::size_t from, to;
  Pose C, C_inverse;
  Matrix adjoint;     ///< of C
  Matrix covariance;  ///< of the loop alone, along the axes of the map
};

template <class Pose>
Loop<Pose> makeLoop(const GraphEdge<Pose>& edge, const DeadReckoning<Pose>& odometry) {
  const Pose C = odometry.pose(edge.to) * edge.T_from_to.inverse() * odometry.pose(edge.from).inverse();
  const typename Motion<Pose>::Matrix to_map = Motion<Pose>::adjoint(odometry.pose(edge.to));
  return {edge.from,
          edge.to,
          C,
          C.inverse(),
          Motion<Pose>::adjoint(C),
          to_map * covarianceOf(edge) * to_map.transpose()};
}

/// Squared distance of the cycle a^-1, odometry, b, odometry from no motion, in units of its covariance,
/// along the axes of the map. The way between the loops' beginnings is seen through loop a.
template <class Pose>
double disagreement(const Loop<Pose>& a, const Loop<Pose>& b, const DeadReckoning<Pose>& odometry) {
  const typename Motion<Pose>::Vector error = Motion<Pose>::log(Pose(a.C * b.C_inverse));
  const typename Motion<Pose>::Matrix covariance =
      a.covariance + b.covariance + odometry.between(a.to, b.to) +
      a.adjoint * odometry.between(a.from, b.from) * a.adjoint.transpose();
  return error.dot(covariance.ldlt().solve(error));
}

/// Largest cliques one after the other, each among the loops that are in none yet.
void findSets(const odometry::ConsistencyGraph& pairs, const ConsistencyParams& params,
              ConsistentLoops& result) {
  std::vector<std::size_t> rest(pairs.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  while (!rest.empty() && result.sets.size() < static_cast<std::size_t>(params.most_sets)) {
    odometry::ConsistencyGraph among(rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (pairs.connected(rest[i], rest[j])) among.connect(i, j);
    const auto clique = odometry::largestClique(among, static_cast<std::size_t>(params.search_budget));
    if (result.sets.empty()) result.largest = clique.optimal;
    if (clique.members.size() < 2 && !result.sets.empty()) return;
    std::vector<std::size_t> members, others;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const bool in = std::binary_search(clique.members.begin(), clique.members.end(), i);
      (in ? members : others).push_back(rest[i]);
    }
    result.sets.push_back(std::move(members));
    rest = std::move(others);
  }
}

}  // namespace

void ConsistencyParams::describe(ParameterVisitor& visitor) {
  visitor.real("confidence", confidence, {0.5, 0.999999}, "",
               "probability with which two true loops are to agree");
  visitor.integer("search_budget", search_budget, {1, 1000000}, "",
                  "nodes of the search for a largest set of loops that agree");
  visitor.integer("most_sets", most_sets, {1, 1000}, "", "such sets that are looked for, the largest first");
}

template <class Pose>
ConsistentLoops consistentLoops(const PoseGraph<Pose>& graph, const ConsistencyParams& params) {
  ConsistentLoops result;
  if (graph.poses.empty()) return result;
  const std::vector<bool> is_loop = loopsOf(graph);
  const DeadReckoning<Pose> odometry(graph);
  std::vector<Loop<Pose>> loops;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (!is_loop[e]) continue;
    result.loops.push_back(e);
    loops.push_back(makeLoop(graph.edges[e], odometry));
  }
  const double gate = chiSquareQuantile(Motion<Pose>::kDof, params.confidence);
  odometry::ConsistencyGraph pairs(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (disagreement(loops[i], loops[j], odometry) < gate) pairs.connect(i, j);
  findSets(pairs, params, result);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    std::size_t agrees = 0;
    if (!result.sets.empty())
      for (const std::size_t j : result.sets.front()) agrees += pairs.connected(i, j) ? 1 : 0;
    result.agrees.push_back(agrees);
  }
  return result;
}

template ConsistentLoops consistentLoops(const PlanarGraph&, const ConsistencyParams&);
template ConsistentLoops consistentLoops(const SpatialGraph&, const ConsistencyParams&);

}  // namespace stereo_nav::mapping
