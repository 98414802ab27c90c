#include "mapping/map/graph_optimiser.h"

#include <gtest/gtest.h>

#include "core/statistics.h"
#include "mapping/map/chordal_start.h"
#include "mapping/map/edge_error.h"
#include "unit/mapping/map/graph_scene.h"

namespace stereo_nav::mapping {
namespace {

TEST(OptimiseGraph, ClosesLapsToWhatTheNoiseLeaves) {
  double chi_squares = 0.0, drift_m = 0.0, closed_m = 0.0;
  constexpr int kSeeds = 10;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Laps laps = drivenLaps(seed);
    const double before_m = rmsDistance(laps.graph, laps.truth);
    const OptimiserResult result = optimise(laps.graph, OptimiserParams());
    EXPECT_TRUE(result.converged);
    drift_m += before_m;
    closed_m += rmsDistance(laps.graph, laps.truth);
    chi_squares += result.chi_square_after;
  }
  EXPECT_LT(closed_m, 0.6 * drift_m);
  // 107 odometry edges and 72 loops, 107 free poses: 72 x 3 degrees of freedom remain.
  const double mean = chi_squares / kSeeds, freedom = 72.0 * 3.0;
  EXPECT_NEAR(mean, freedom, 3.0 * std::sqrt(2.0 * freedom / kSeeds));
}

TEST(OptimiseGraph, GivesTheSameBytesTwice) {
  Laps first = drivenLaps(1), second = drivenLaps(1);
  optimise(first.graph, OptimiserParams());
  optimise(second.graph, OptimiserParams());
  EXPECT_EQ(toG2o(first.graph), toG2o(second.graph));
}

TEST(OptimiseGraph, LeavesOutEdgesOfNoWeightAndKeepsSeparatePartsInPlace) {
  Laps laps = drivenLaps(2);
  const PlanarGraph chain = laps.graph;
  EdgeUse use;
  use.weights.assign(laps.graph.edges.size(), 0.0);
  for (std::size_t e = 0; e < 50; ++e) use.weights[e] = 1.0;  // vertices 0 to 50
  optimise(laps.graph, OptimiserParams(), use);
  EXPECT_LT(rmsDistance(laps.graph, chain), 1e-9);
}

TEST(ChordalStart, IsTheAnswerWhereThereIsNoNoise) {
  Laps laps = drivenLaps(3);
  for (auto& edge : laps.graph.edges)
    edge.T_from_to = laps.truth.poses[edge.from].inverse() * laps.truth.poses[edge.to];
  for (std::size_t v = 1; v < laps.graph.poses.size(); ++v) laps.graph.poses[v].setIdentity();
  laps.graph.poses = chordalStart(laps.graph);
  EXPECT_LT(rmsDistance(laps.graph, laps.truth), 1e-9);
}

struct Optimum {
  const char* file;
  double chi_square;
};

class PublicGraphs : public ::testing::TestWithParam<Optimum> {};

TEST_P(PublicGraphs, ReachTheirOptimum) {
  if (graphFolder().empty()) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  std::visit(
      [](auto graph) {
        const OptimiserResult result = optimise(graph, OptimiserParams());
        EXPECT_NEAR(result.chi_square_after, GetParam().chi_square, 1e-4 * GetParam().chi_square);
      },
      readG2o(graphFolder() + GetParam().file));
}

INSTANTIATE_TEST_SUITE_P(G2o, PublicGraphs,
                         ::testing::Values(Optimum{"intel.g2o", 45.005}, Optimum{"manhattan.g2o", 3549.04},
                                           Optimum{"kitti_05.g2o", 157.10}, Optimum{"sphere2500.g2o", 727.15},
                                           Optimum{"parking-garage.g2o", 1.2387}));

}  // namespace
}  // namespace stereo_nav::mapping
