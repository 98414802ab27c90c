#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "odometry/common/greedy_clique.h"

namespace stereo_nav::odometry {
namespace {

using Members = std::vector<std::size_t>;

TEST(GreedyClique, EmptyGraphHasNone) {
  EXPECT_TRUE(greedyClique(ConsistencyGraph(0)).empty());
}

TEST(GreedyClique, WithoutEdgesOneNodeRemains) {
  EXPECT_EQ(greedyClique(ConsistencyGraph(5)), Members({0}));
}

TEST(GreedyClique, FindsTheRigidGroupAmongLoosePairs) {
  // 0-1-2-3 are all connected; 4 and 5 are connected to single members.
  ConsistencyGraph graph(6);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) graph.connect(i, j);
  }
  graph.connect(3, 4);
  graph.connect(0, 5);
  EXPECT_EQ(greedyClique(graph), Members({0, 1, 2, 3}));
}

TEST(GreedyClique, TakesTheNextMemberByConnectionsAmongTheCandidates) {
  // Node 0 is connected to all. Among its neighbours 1 has the higher degree in the whole graph (it is
  // connected to 6, 7, 8), but 3, 4, 5 are connected to one another: the count among candidates must decide,
  // as in the thesis.
  ConsistencyGraph graph(9);
  for (std::size_t i = 1; i <= 5; ++i) graph.connect(0, i);
  graph.connect(1, 2);
  for (std::size_t i = 6; i <= 8; ++i) graph.connect(1, i);
  graph.connect(3, 4);
  graph.connect(3, 5);
  graph.connect(4, 5);
  EXPECT_EQ(greedyClique(graph), Members({0, 3, 4, 5}));
}

TEST(GreedyClique, IsGreedyAndMayMissTheMaximum) {
  // A star of high degree draws the greedy choice away from the triangle 5-6-7: the documented weakness.
  ConsistencyGraph graph(8);
  for (std::size_t i = 1; i <= 4; ++i) graph.connect(0, i);
  graph.connect(5, 6);
  graph.connect(5, 7);
  graph.connect(6, 7);
  EXPECT_EQ(greedyClique(graph), Members({0, 1}));
}

TEST(GreedyClique, IsACliqueAndMaximalOnRandomGraphs) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    const std::size_t size = 1 + random() % 130;  // beyond two words of bits
    ConsistencyGraph graph(size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = i + 1; j < size; ++j) {
        if (random() % 10 < 6) graph.connect(i, j);
      }
    }
    const Members clique = greedyClique(graph);
    for (const std::size_t i : clique) {
      for (const std::size_t j : clique) ASSERT_TRUE(i == j || graph.connected(i, j));
    }
    for (std::size_t extra = 0; extra < size; ++extra) {
      if (std::count(clique.begin(), clique.end(), extra) != 0) continue;
      ASSERT_FALSE(std::all_of(clique.begin(), clique.end(),
                               [&](std::size_t member) { return graph.connected(member, extra); }));
    }
  }
}

}  // namespace
}  // namespace stereo_nav::odometry
