// Scans, walls and what a scan tells, each by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "odometry/laser/correlative_search.h"
#include "odometry/laser/laser_scan.h"
#include "odometry/laser/line_map.h"
#include "odometry/laser/measured_motion.h"
#include "odometry/laser/told_directions.h"
#include "walled_world.h"

namespace stereo_nav::odometry {
namespace {

TEST(LaserScan, beamsWithoutAReturnAreTold) {
  LaserScan scan;
  scan.angle_increment_rad = 0.5 * kPi;
  scan.time_increment_s = 0.01;
  scan.range_min_m = 0.1;
  scan.range_max_m = 10.0;
  const float infinity = std::numeric_limits<float>::infinity();
  scan.ranges_m = {2.0F, infinity, -infinity, std::nanf(""), 3.0F, 0.05F, 11.0F, 0.0F};
  const LaserPoints points = pointsOf(scan, Eigen::Isometry3d::Identity());
  ASSERT_EQ(points.points.size(), 2u);
  EXPECT_EQ(points.invalid, 1u);
  EXPECT_EQ(points.without_return, 5u);
  EXPECT_LT((points.points[0].p_base - Eigen::Vector2d(2.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((points.points[1].p_base - Eigen::Vector2d(3.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(points.points[1].after_s, 0.04, 1e-12);
}

TEST(LaserScan, aLaserUpsideDownSeesTheOtherSide) {
  LaserScan scan;
  scan.angle_min_rad = 0.5 * kPi;
  scan.angle_increment_rad = -0.1;
  scan.range_max_m = 10.0;
  scan.ranges_m = {2.0F};
  Eigen::Isometry3d T_base_laser(Eigen::Translation3d(0.3, 0.0, 0.2));
  T_base_laser.rotate(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
  const LaserPoints points = pointsOf(scan, T_base_laser);
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_LT((points.points[0].p_base - Eigen::Vector2d(0.3, -2.0)).norm(), 1e-9);
}

TEST(LineMap, findsAWallAndForgetsIt) {
  LineMap map(0.1, 2);
  std::vector<Eigen::Vector2d> wall, other;
  for (int i = 0; i < 200; ++i) {
    wall.emplace_back(0.02 * i, 1.0 + 0.01 * i);  // rises by one in two
    other.emplace_back(-5.0, 0.02 * i);
  }
  map.add(wall);
  const MapLine* line = map.lineAt({2.0, 2.03}, 0);
  ASSERT_NE(line, nullptr);
  EXPECT_NEAR(std::abs(line->normal.dot(Eigen::Vector2d(1.0, -2.0).normalized())), 1.0, 1e-6);
  EXPECT_NEAR(line->normal.dot(Eigen::Vector2d(2.0, 2.0) - line->centre), 0.0, 1e-6);
  EXPECT_EQ(map.lineAt({2.0, 5.0}, 0), nullptr);
  map.add(other);
  map.add(other);  // two scans are kept: the wall is gone
  EXPECT_EQ(map.lineAt({2.0, 2.03}, 0), nullptr);
  EXPECT_NE(map.lineAt({-5.0, 2.0}, 0), nullptr);
}

TEST(LineMap, aCornerIsNoWall) {
  LineMap map(0.1, 2);
  std::vector<Eigen::Vector2d> corner;
  for (int i = 0; i < 40; ++i) {
    corner.emplace_back(0.025 * i, 0.0);
    corner.emplace_back(0.0, 0.025 * i);
  }
  map.add(corner);
  EXPECT_EQ(map.lineAt({0.05, 0.05}, 0), nullptr);
  EXPECT_NE(map.lineAt({0.6, 0.01}, 0), nullptr);
}

/// Cells in memory, at most, while a way of so many scans was driven.
std::size_t mostCellsOfAWay(int scans) {
  LineMap map(0.1, 3);
  std::size_t most = 0;
  for (int i = 0; i < scans; ++i) {
    std::vector<Eigen::Vector2d> walls;
    for (int k = 0; k < 100; ++k) walls.emplace_back(3.0 * i + 0.04 * k, k % 2 == 0 ? 1.0 : -1.0);
    map.add(walls);
    for (int k = 0; k < 100; ++k) map.lineAt({3.0 * i + 0.04 * k, 0.01 * k}, 0);  // in the open, most of them
    most = std::max(most, map.cells());
    EXPECT_NE(map.lineAt({3.0 * i + 2.0, 1.0}, 0), nullptr);
  }
  return most;
}

TEST(LineMap, holdsNoMoreOfALongWayThanOfAShortOne) {
  const std::size_t of_short_way = mostCellsOfAWay(50);
  EXPECT_LT(of_short_way, 12000u);
  EXPECT_LT(mostCellsOfAWay(500), of_short_way + of_short_way / 2);
}

TEST(MotionInputs, aWrongStampSilencesWheelsAndGyroscopeForAMomentOnly) {
  MotionInputs inputs;
  const auto feed = [&inputs](double time_s, double x_m) {
    inputs.addWheels(time_s, planarPose({x_m, 0.0, 0.0}));
    ImuSample sample;
    sample.time_s = time_s;
    sample.angular_velocity = Eigen::Vector3d(0.0, 0.0, 0.5);
    inputs.addImu(sample, Eigen::Matrix3d::Identity());
  };
  for (int i = 0; i < 200; ++i) {
    feed(0.02 * i, 0.01 * i);
    if (i == 100) feed(1e6, 1.0);
  }
  const MeasuredMotion before = inputs.between(1.9, 2.1), motion = inputs.between(2.5, 2.6);
  EXPECT_EQ(before.translation, RateSource::kNone);
  EXPECT_EQ(motion.translation, RateSource::kWheels);
  EXPECT_EQ(motion.rotation, RateSource::kGyro);
  ASSERT_FALSE(motion.pieces.empty());
  EXPECT_NEAR(motion.pieces.front().rate.x(), 0.5, 1e-6);
  EXPECT_NEAR(motion.pieces.front().rate.z(), 0.5, 1e-6);
}

TEST(ToldDirections, aCorridorTellsAllButItsDirection) {
  ScanInformation information;
  information.weight = 100.0;
  information.lever_m = 2.0;
  // Walls along a direction of 30 degrees: their normals lie across it.
  const Eigen::Vector3d across(-0.5, std::sqrt(0.75), 0.0);
  information.told = 100.0 * across * across.transpose();
  information.told(2, 2) = 100.0 * 4.0;
  const ToldDirections directions = toldDirections(information, 0.01);
  ASSERT_EQ(directions.untold.size(), 1u);
  EXPECT_NEAR(std::abs(directions.untold[0].x()), std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(std::abs(directions.untold[0].y()), 0.5, 1e-6);
  const Eigen::Vector3d along(std::sqrt(0.75), 0.5, 0.0);
  EXPECT_LT((directions.projection * along).norm(), 1e-6);
  EXPECT_LT((directions.projection * across - across).norm(), 1e-6);
  EXPECT_LT((directions.projection * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
}

TEST(ToldDirections, whatNormalsFeignIsNotTold) {
  ScanInformation information;
  information.weight = 100.0;
  information.told = Eigen::Vector3d(3.0, 97.0, 50.0).asDiagonal();
  EXPECT_TRUE(toldDirections(information, 0.01).untold.empty());
  information.feigned = Eigen::Vector3d(2.9, 0.0, 0.0).asDiagonal();
  EXPECT_EQ(toldDirections(information, 0.01).untold.size(), 1u);
}

TEST(CellGrid, keepsCellsOfAllQuadrantsApartAndForgetsEmptyTiles) {
  CellGrid<int> grid;
  for (int ix = -20; ix <= 20; ++ix)
    for (int iy = -20; iy <= 20; ++iy) grid.at(ix, iy) = 100 * ix + iy;
  for (int ix = -20; ix <= 20; ++ix)
    for (int iy = -20; iy <= 20; ++iy) {
      ASSERT_NE(grid.find(ix, iy), nullptr);
      ASSERT_EQ(*grid.find(ix, iy), 100 * ix + iy);
    }
  EXPECT_EQ(grid.find(20, 30), nullptr);
  EXPECT_EQ(grid.cells(), 36u * 64u) << "tiles from -24 to 23";
  grid.forget([](int cell) { return cell != 1212; });
  EXPECT_EQ(grid.cells(), 64u);
  EXPECT_EQ(*grid.find(12, 12), 1212);
  EXPECT_EQ(grid.find(-12, 12), nullptr);
  grid.clear();
  EXPECT_EQ(grid.find(12, 12), nullptr);
}

TEST(SearchRaster, countsPointsInACellAndBesideItAndIsDrawnAnewAfterAChange) {
  LineMap map(0.1, 5);
  map.add({{5.05, -2.05}, {40.0, 0.0}});
  SearchRaster raster;
  raster.draw(map, {1.0, 1.0});
  const auto fine = [&raster](double x, double y) {
    return static_cast<int>(raster.fine()[static_cast<std::size_t>(raster.placeOf({x, y}))]);
  };
  const auto coarse = [&raster](double x, double y) {
    return static_cast<int>(raster.coarse()[static_cast<std::size_t>(raster.placeOf({x, y}))]);
  };
  EXPECT_EQ(fine(5.05, -2.05), 2);
  EXPECT_EQ(fine(5.15, -1.95), 1);
  EXPECT_EQ(fine(5.25, -2.05), 0);
  EXPECT_EQ(coarse(5.15, -1.95), 2);
  EXPECT_EQ(coarse(5.25, -2.25), 1);
  EXPECT_EQ(coarse(5.35, -2.05), 0);
  const auto shifted =
      static_cast<std::size_t>(raster.placeOf({5.35, -2.35}) + SearchRaster::placesOfShift(-3, 3));
  EXPECT_EQ(raster.fine()[shifted], 2);
  raster.draw(map, {9.0, 1.0});
  EXPECT_EQ(fine(5.05, -2.05), 2) << "around another middle";
  map.add({{9.05, 1.05}});
  raster.draw(map, {9.0, 1.0});
  EXPECT_EQ(fine(9.05, 1.05), 2);
  map.clear();
  raster.draw(map, {9.0, 1.0});
  EXPECT_EQ(fine(9.05, 1.05), 0);
}

TEST(CorrelativeSearch, findsAScanThatIsFarOff) {
  const WalledWorld room = WalledWorld::room(7.0, 5.0);
  TurningLaser laser{room, [](double) { return Eigen::Vector3d::Zero(); }};
  std::vector<Eigen::Vector2d> points;
  for (const LaserPoint& point : pointsOf(laser.scan(0.0), Eigen::Isometry3d::Identity()).points)
    points.push_back(point.p_base);
  LineMap map(0.1, 5);
  map.add(points);
  PlanarState prior;
  prior.p_odom = {0.5, -0.3};
  prior.yaw_rad = 0.3;
  const Eigen::Matrix3d vague = Eigen::Vector3d(0.25, 0.25, 0.04).asDiagonal();
  SearchRaster raster;
  raster.draw(map, prior.p_odom);
  const std::vector<Eigen::Vector3d> shifts = searchShifts(points, raster, prior, vague);
  ASSERT_FALSE(shifts.empty());
  ASSERT_LE(shifts.size(), kSearchResults);
  const Eigen::Vector3d shift = shifts.front();
  EXPECT_NEAR(shift.x(), -0.5, kSearchStep_m);
  EXPECT_NEAR(shift.y(), 0.3, kSearchStep_m);
  EXPECT_NEAR(shift.z(), -0.3, 2.0 * kSearchStep_rad);
}

}  // namespace
}  // namespace stereo_nav::odometry
