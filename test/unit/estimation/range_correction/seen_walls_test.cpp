#include "estimation/range_correction/seen_walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "hall_map.h"

namespace stereo_nav::estimation::test {
namespace {

constexpr double kDegree = kPi / 180.0;

TEST(SeenWalls, OneWallAheadHasItsLine) {
  const auto walls = wallsOf(hallMap(), {{2.0, 2.5}, 0.0, 1.8 * kDegree, false}, 0.01, 12.0);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_NEAR(walls[0].normal.x(), 1.0, 1e-6);
  EXPECT_NEAR(walls[0].offset_m, 8.0, 1e-6);
  EXPECT_NEAR(walls[0].sigma_m, 0.0, 1e-6);
}

TEST(SeenWalls, AtAnEdgeThereAreTheOneInFrontAndTheOneBehind) {
  // The pillar's lower edge is 3 m up.
  const auto walls = wallsOf(hallMap(), {{2.0, 3.0}, 0.0, 1.8 * kDegree, false}, 0.01, 12.0);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_NEAR(walls[0].offset_m, 5.0, 1e-6);
  EXPECT_NEAR(walls[1].offset_m, 8.0, 1e-6);
}

TEST(SeenWalls, ACornerIsTwoWalls) {
  const double direction = std::atan2(2.0, 2.0);
  const auto walls = wallsOf(hallMap(), {{6.0, 3.0}, direction, 1.8 * kDegree, false}, 0.02, 12.0);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_NEAR(walls[0].normal.y(), 1.0, 1e-3);
  EXPECT_NEAR(walls[1].normal.x(), 1.0, 1e-3);
}

TEST(SeenWalls, NothingInReachIsNoWall) {
  EXPECT_TRUE(wallsOf(hallMap(), {{2.0, 2.5}, 0.0, 0.03, false}, 0.01, 3.0).empty());
  EXPECT_TRUE(wallsOf(hallMap(), {{20.0, 2.5}, 0.0, 0.03, false}, 0.01, 3.0).empty());
}

TEST(SeenWalls, ObliqueWallsOfCellsAreStraight) {
  grid::GridGeometry geometry;
  geometry.width = geometry.height = 120;
  grid::OccupancyGrid map(geometry, grid::kFree);
  const Eigen::Vector2d normal(std::cos(0.4), std::sin(0.4));
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x)
      if (normal.dot(geometry.centreOf({x, y})) > 4.0) map.at({x, y}) = grid::kOccupied;
  const auto walls = wallsOf(map, {{1.0, 1.0}, 0.4, 0.03, false}, 0.01, 12.0);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_NEAR(std::atan2(walls[0].normal.y(), walls[0].normal.x()), 0.4, 0.05);
  EXPECT_NEAR(expectedRange(walls[0], {{1.0, 1.0}, 0.4, 0.03, false}).range_m,
              4.0 - normal.dot(Eigen::Vector2d(1.0, 1.0)), 0.03);
}

TEST(ExpectedRange, OfLightIsAlongTheBeamOfSoundToTheNearestPoint) {
  const SeenWall wall{{1.0, 0.0}, 8.0, 0.0};
  const double oblique = 10.0 * kDegree;
  EXPECT_NEAR(expectedRange(wall, {{2.0, 1.0}, oblique, 15.0 * kDegree, false}).range_m,
              6.0 / std::cos(oblique), 1e-12);
  EXPECT_NEAR(expectedRange(wall, {{2.0, 1.0}, oblique, 15.0 * kDegree, true}).range_m, 6.0, 1e-12);
  EXPECT_NEAR(expectedRange(wall, {{2.0, 1.0}, 40.0 * kDegree, 15.0 * kDegree, true}).range_m,
              6.0 / std::cos(25.0 * kDegree), 1e-12);
}

TEST(ExpectedRange, DerivativesAreThoseOfTheFunction) {
  const SeenWall wall{Eigen::Vector2d(0.8, 0.6), 4.0, 0.0};
  const double h = 1e-6;
  for (const bool nearest : {false, true}) {
    for (const double direction : {0.2, 0.64, 1.1}) {
      const Beam beam{{0.5, 0.3}, direction, 0.05, nearest};
      const ExpectedRange expected = expectedRange(wall, beam);
      Beam moved = beam;
      moved.direction_rad += h;
      EXPECT_NEAR(expected.by_direction_m_rad, (expectedRange(wall, moved).range_m - expected.range_m) / h,
                  1e-4);
      for (int axis = 0; axis < 2; ++axis) {
        moved = beam;
        moved.p_map[axis] += h;
        EXPECT_NEAR(expected.by_position[axis], (expectedRange(wall, moved).range_m - expected.range_m) / h,
                    1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace stereo_nav::estimation::test
