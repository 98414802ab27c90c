#include "mapping/map/covisibility_graph.h"

#include <gtest/gtest.h>

namespace stereo_nav::mapping {
namespace {

/// Keyframes that see these landmarks.
VisualMap mapSeeing(const std::vector<std::vector<std::uint64_t>>& ids) {
  VisualMap map;
  for (const auto& of_keyframe : ids) {
    map.keyframes.emplace_back();
    for (const std::uint64_t id : of_keyframe) {
      vision::KeyframeCorner corner;
      corner.landmark_id = id;
      map.keyframes.back().keyframe.corners.push_back(corner);
    }
  }
  return map;
}

TEST(CovisibilityGraph, JoinsKeyframesThatShareLandmarks) {
  // Corners that nobody follows have the id 0: they are not the same landmark.
  const auto edges = covisibilityGraph(mapSeeing({{1, 2, 3, 0}, {2, 3, 4, 0}, {3, 4, 5, 0}, {0, 9}}), 2);
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0].first, 0U);
  EXPECT_EQ(edges[0].second, 1U);
  EXPECT_EQ(edges[1].first, 1U);
  EXPECT_EQ(edges[1].second, 2U);
  EXPECT_EQ(edges[1].shared, 2U);
}

TEST(CovisibilityGraph, HasTheSpanningTreeThatSharesMost) {
  const std::vector<CovisibilityEdge> edges = {{0, 1, 20}, {0, 2, 50}, {1, 2, 40}, {3, 4, 15}};
  const auto tree = spanningTree(5, edges);
  ASSERT_EQ(tree.size(), 3U);
  EXPECT_EQ(tree[0].shared, 50U);
  EXPECT_EQ(tree[1].shared, 40U);
  EXPECT_EQ(tree[2].shared, 15U);
}

}  // namespace
}  // namespace stereo_nav::mapping
