#include "grid/ray_cast.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/angles.h"

namespace stereo_nav::grid {
namespace {

/// 4 x 3 m, of 0.1 m cells, turned by 90 degrees about its corner at (1, 2), with a wall across columns 20
/// to 21.
OccupancyGrid turnedRoom() {
  GridGeometry geometry;
  geometry.width = 40;
  geometry.height = 30;
  geometry.resolution_m = 0.1;
  geometry.origin_x_m = 1.0;
  geometry.origin_y_m = 2.0;
  geometry.origin_yaw_rad = kPi / 2.0;
  OccupancyGrid grid(geometry, kFree);
  for (int y = 0; y < 30; ++y) grid.at({20, y}) = grid.at({21, y}) = kOccupied;
  return grid;
}

TEST(CastRay, MeetsAWallAtItsSide) {
  const OccupancyGrid grid = turnedRoom();
  // Columns run along the map's y axis: the wall begins 2 m above the origin.
  const RayHit hit = castRay(grid, {0.0, 2.5}, kPi / 2.0, 10.0);
  EXPECT_TRUE(hit.hit);
  EXPECT_NEAR(hit.distance_m, 1.5, 1e-9);
  EXPECT_EQ(hit.cell.x, 20);
  EXPECT_EQ(hit.cell.y, 10);
  const RayHit slanted = castRay(grid, {0.0, 2.5}, kPi / 2.0 + kPi / 6.0, 10.0);
  EXPECT_NEAR(slanted.distance_m, 1.5 / std::cos(kPi / 6.0), 1e-9);
}

TEST(CastRay, SaysWhereNothingIsWithinItsRange) {
  const OccupancyGrid grid = turnedRoom();
  EXPECT_FALSE(castRay(grid, {0.0, 2.5}, kPi / 2.0, 1.4).hit);
  const RayHit away = castRay(grid, {0.0, 2.5}, -kPi / 2.0, 5.0);
  EXPECT_FALSE(away.hit);
  EXPECT_EQ(away.distance_m, 5.0);
  EXPECT_NEAR(castRay(grid, {0.0, 1.0}, kPi / 2.0, 10.0).distance_m, 3.0, 1e-9)
      << "from outside, through the edge";
}

TEST(Traverse, VisitsNeighboursFromEndToEnd) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-20.0, 20.0);
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::Vector2d from(place(generator), place(generator)), to(place(generator), place(generator));
    if (trial % 5 == 0) from = from.array().floor() + 0.5;  // through corners
    if (trial % 10 == 0) to = from + Eigen::Vector2d(7.0, trial % 20 == 0 ? 7.0 : -7.0);
    std::vector<Cell> cells;
    EXPECT_TRUE(traverse(from, to, [&](Cell cell, double share) {
      const Eigen::Vector2d entry = from + share * (to - from);
      EXPECT_NEAR(std::max({cell.x - entry.x(), entry.x() - cell.x - 1.0, 0.0}), 0.0, 1e-6);
      EXPECT_NEAR(std::max({cell.y - entry.y(), entry.y() - cell.y - 1.0, 0.0}), 0.0, 1e-6);
      cells.push_back(cell);
      return true;
    }));
    EXPECT_EQ(cells.back().x, static_cast<int>(std::floor(to.x())));
    EXPECT_EQ(cells.back().y, static_cast<int>(std::floor(to.y())));
    for (std::size_t i = 1; i < cells.size(); ++i)
      EXPECT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1);
  }
}

}  // namespace
}  // namespace stereo_nav::grid
