#include "mapping/map/false_loops.h"

#include <cmath>
#include <random>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kFewestBetween = 10;
constexpr double kReach_m = 0.5;

/// Uniform numbers from the generator's bits alone: the library's distributions differ between systems.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }
  double within(double half_width) {
    return half_width * (2.0 * static_cast<double>(generator_() >> 11) / 9007199254740992.0 - 1.0);
  }

 private:
  std::mt19937_64 generator_;
};

void drawMotion(Draw& draw, Eigen::Isometry2d& T) {
  const double x_m = draw.within(kReach_m), y_m = draw.within(kReach_m);
  T = Eigen::Translation2d(x_m, y_m) * Eigen::Rotation2Dd(draw.within(kPi));
}

void drawMotion(Draw& draw, Eigen::Isometry3d& T) {
  const double x_m = draw.within(kReach_m), y_m = draw.within(kReach_m), z_m = draw.within(kReach_m);
  T = Eigen::Translation3d(x_m, y_m, z_m) * Eigen::AngleAxisd(draw.within(kPi), Eigen::Vector3d::UnitZ());
}

}  // namespace

template <class Pose>
std::size_t addFalseLoops(PoseGraph<Pose>& graph, double share, std::uint64_t seed) {
  const std::size_t first = graph.edges.size(), vertices = graph.poses.size();
  std::vector<std::size_t> true_loops;
  const std::vector<bool> is_loop = loopsOf(graph);
  for (std::size_t e = 0; e < first; ++e)
    if (is_loop[e]) true_loops.push_back(e);
  if (true_loops.empty() || vertices <= 2 * kFewestBetween)
    throw InputError("a graph of at least 20 vertices with a loop is needed to add false ones to");
  Draw draw(seed);
  const auto count = static_cast<std::size_t>(std::lround(share * static_cast<double>(true_loops.size())));
  while (graph.edges.size() < first + count) {
    GraphEdge<Pose> edge;
    edge.from = draw.below(vertices);
    edge.to = draw.below(vertices);
    if (edge.from + kFewestBetween > edge.to) continue;
    edge.information = graph.edges[true_loops[draw.below(true_loops.size())]].information;
    drawMotion(draw, edge.T_from_to);
    graph.edges.push_back(edge);
  }
  return first;
}

template std::size_t addFalseLoops(PlanarGraph&, double, std::uint64_t);
template std::size_t addFalseLoops(SpatialGraph&, double, std::uint64_t);

}  // namespace stereo_nav::mapping
