#include "mapping/map/robust_optimiser.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/map/false_loops.h"
#include "unit/mapping/map/graph_scene.h"

namespace stereo_nav::mapping {
namespace {

struct Kept {
  std::size_t of_true = 0, of_false = 0, all_true = 0;
};

Kept count(const RobustResult& result, std::size_t first_false) {
  Kept kept;
  for (const LoopVerdict& loop : result.loops) {
    const bool is_true = loop.edge < first_false;
    kept.all_true += is_true ? 1 : 0;
    (is_true ? kept.of_true : kept.of_false) += loop.kept ? 1 : 0;
    EXPECT_EQ(loop.kept, loop.reason.empty());
  }
  return kept;
}

TEST(MutualConsistency, FindsTheLoopsThatAgree) {
  Laps laps = drivenLaps(1);
  const std::size_t first_false = addFalseLoops(laps.graph, 0.5, 4);
  const ConsistentLoops found = consistentLoops(laps.graph, ConsistencyParams());
  ASSERT_EQ(found.loops.size(), 72U + 36U);
  const auto true_members = std::count_if(found.sets[0].begin(), found.sets[0].end(),
                                          [&](std::size_t i) { return found.loops[i] < first_false; });
  EXPECT_GE(true_members, 55);
  EXPECT_LE(found.sets[0].size(), static_cast<std::size_t>(true_members) + 3U);
  for (std::size_t s = 1; s < found.sets.size(); ++s)
    EXPECT_LE(found.sets[s].size(), found.sets[s - 1].size());
}

TEST(OptimiseRobustly, RejectsFalseLoopsAndSaysWhy) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Laps laps = drivenLaps(seed);
    PlanarGraph clean = laps.graph;
    optimise(clean, OptimiserParams());
    const std::size_t first_false = addFalseLoops(laps.graph, 0.5, seed);
    const RobustResult result = optimiseRobustly(laps.graph, RobustParams());
    const Kept kept = count(result, first_false);
    EXPECT_GE(kept.of_true, 69U);  // 95 % of 72
    EXPECT_LE(kept.of_false, 1U);
    EXPECT_LT(rmsDistance(laps.graph, clean), 0.05);
  }
}

TEST(OptimiseRobustly, JoinsWhatTheOdometryDoesNot) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Laps laps = drivenLaps(seed);
    PlanarGraph clean = laps.graph;
    optimise(clean, OptimiserParams());
    laps.graph.edges.erase(laps.graph.edges.begin() + 53);  // the odometry began anew, elsewhere
    for (std::size_t v = 54; v < laps.graph.poses.size(); ++v)
      laps.graph.poses[v] = Eigen::Translation2d(20.0, -7.0) * Eigen::Rotation2Dd(2.0) * laps.graph.poses[v];
    const std::size_t first_false = addFalseLoops(laps.graph, 0.3, seed);
    const Kept kept = count(optimiseRobustly(laps.graph, RobustParams()), first_false);
    EXPECT_GE(kept.of_true, 69U);
    EXPECT_LE(kept.of_false, 1U);
    EXPECT_LT(rmsDistance(laps.graph, clean), 0.1);
  }
}

TEST(OptimiseRobustly, RevokesALoopWhenOthersSpeakAgainstIt) {
  Laps laps = drivenLaps(3);
  const auto true_loops = laps.graph.edges;
  GraphEdge<Eigen::Isometry2d> wrong = true_loops.back();
  wrong.T_from_to.pretranslate(Eigen::Vector2d(0.15, 0.1));  // within what the odometry alone leaves open
  laps.graph.edges.resize(107);
  laps.graph.edges.push_back(wrong);
  EXPECT_TRUE(optimiseRobustly(laps.graph, RobustParams()).loops.back().kept);
  laps.graph.edges.insert(laps.graph.edges.end(), true_loops.begin() + 107, true_loops.end());
  const RobustResult result = optimiseRobustly(laps.graph, RobustParams());
  EXPECT_FALSE(result.loops.front().kept);
  EXPECT_NE(result.loops.front().reason.find("against the map"), std::string::npos);
}

/// The public graphs with false loops: distance from the clean optimum and true loops kept.
struct Bound {
  const char* file;
  double share, rms_m;
};

class PublicGraphsWithFalseLoops : public ::testing::TestWithParam<Bound> {};

TEST_P(PublicGraphsWithFalseLoops, ComeOutAsWithoutThem) {
  if (graphFolder().empty()) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  auto graph = std::get<PlanarGraph>(readG2o(graphFolder() + GetParam().file));
  PlanarGraph clean = graph;
  optimise(clean, OptimiserParams());
  const std::size_t first_false = addFalseLoops(graph, GetParam().share, 1);
  const Kept kept = count(optimiseRobustly(graph, RobustParams()), first_false);
  EXPECT_LT(rmsDistance(graph, clean), GetParam().rms_m);
  EXPECT_GE(static_cast<double>(kept.of_true), 0.95 * static_cast<double>(kept.all_true));
}

INSTANTIATE_TEST_SUITE_P(G2o, PublicGraphsWithFalseLoops,
                         ::testing::Values(Bound{"intel.g2o", 0.1, 0.25}, Bound{"kitti_05.g2o", 0.1, 0.1},
                                           Bound{"intel.g2o", 0.5, 1.3}, Bound{"kitti_05.g2o", 0.5, 0.1}));

}  // namespace
}  // namespace stereo_nav::mapping
