#include "navigation/obstacles/obstacle_map.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "unit/navigation/obstacles/drawn_disparity.h"

namespace stereo_nav::navigation {
namespace {

/// A wall across the view at x, from the floor up to a height.
double wallAt(double x_m, double height_m, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const double t = (x_m - origin.x()) / direction.x();
  const double z = origin.z() + t * direction.z();
  return t > 0.0 && z >= 0.0 && z <= height_m ? t : INFINITY;
}

class ObstacleMapTest : public testing::Test {
 protected:
  using Scene = std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>;

  void look(const Scene& scene, int frames = 10) {
    for (int i = 0; i < frames; ++i) {
      time_s_ += 0.1;
      map_.addDisparity(time_s_, drawDisparity(camera_, 0.3, ++seed_, scene), camera_,
                        Eigen::Isometry3d::Identity());
    }
  }
  int value(double x, double y) { return map_.grid().at(map_.grid().geometry.cellAt({x, y})); }
  /// Whether a cell on the way from x0 to x1 is occupied.
  bool occupied(double x0, double x1, double y) {
    for (double x = x0; x <= x1; x += 0.025)
      if (value(x, y) == grid::kOccupied) return true;
    return false;
  }
  int occupiedCells() {
    int count = 0;
    for (const std::int8_t cell : map_.grid().cells) count += cell == grid::kOccupied ? 1 : 0;
    return count;
  }

  const Scene floor_ = [](const auto& origin, const auto& direction) {
    return planeAt(0.0, origin, direction);
  };
  const DisparityCamera camera_ = drawnCamera(5.0 * kRadPerDeg);
  ObstacleMap map_{ObstacleParams()};
  double time_s_ = 10.0;
  unsigned seed_ = 0;
};

TEST_F(ObstacleMapTest, ShowsAFreeFloorAndWhatItCannotSeeAsUnknown) {
  look(floor_);
  EXPECT_EQ(occupiedCells(), 0);
  EXPECT_EQ(value(2.0, 0.0), grid::kFree);
  EXPECT_EQ(value(0.5, 0.0), grid::kUnknown) << "below the image, and nearer than the largest disparity";
  EXPECT_EQ(value(1.0, 2.0), grid::kUnknown) << "beside the view";
  EXPECT_EQ(value(-1.0, 0.0), grid::kUnknown) << "behind";
}

TEST_F(ObstacleMapTest, ShowsWhatStandsOnTheFloor) {
  for (const double height_m : {0.12, 1.0}) {
    map_.clear();
    look([&](const auto& origin, const auto& direction) {
      return std::min(floor_(origin, direction), wallAt(2.0, height_m, origin, direction));
    });
    for (double y = -0.4; y <= 0.5; y += 0.1) EXPECT_TRUE(occupied(1.9, 2.1, y)) << height_m << " at " << y;
    for (double y = -0.3; y <= 0.4; y += 0.1) EXPECT_FALSE(occupied(1.0, 1.85, y)) << height_m << " at " << y;
    EXPECT_EQ(value(1.5, 0.0), grid::kFree);
  }
}

TEST_F(ObstacleMapTest, ShowsWhatWentAwayNoMoreAfterTwoSeconds) {
  look(
      [&](const auto& origin, const auto& direction) {
        return std::min(floor_(origin, direction), wallAt(2.0, 1.7, origin, direction));
      },
      50);
  EXPECT_TRUE(occupied(1.9, 2.1, 0.0));
  look(floor_, 20);
  EXPECT_EQ(occupiedCells(), 0);
}

TEST_F(ObstacleMapTest, ShowsAHoleButNotWhatAFloorMirrors) {
  // 0.3 m wide along the way, 0.1 m deep.
  look([&](const auto& origin, const auto& direction) {
    const double t = floor_(origin, direction);
    const double x = origin.x() + t * direction.x();
    return x > 1.1 && x < 1.4 ? std::min(planeAt(-0.1, origin, direction),
                                         wallAt(1.4, 0.0, origin + Eigen::Vector3d(0, 0, 0.1), direction))
                              : t;
  });
  EXPECT_TRUE(occupied(1.05, 1.4, 0.0));
  map_.clear();
  // A wall at 2 m and its mirror image below it: rays that are mirrored go on as if the floor were not there.
  look([&](const auto& origin, const auto& direction) {
    const double t = floor_(origin, direction), to_wall = (2.0 - origin.x()) / direction.x();
    if (t > to_wall) return to_wall;
    const double x = origin.x() + t * direction.x();
    return x > 1.7 ? to_wall : t;
  });
  EXPECT_FALSE(occupied(1.0, 1.8, 0.0));
  EXPECT_TRUE(occupied(1.9, 2.1, 0.0));
}

TEST_F(ObstacleMapTest, KeepsWhatTheCameraSeesWhereALaserSeesOverIt) {
  look([&](const auto& origin, const auto& direction) {
    return std::min(floor_(origin, direction), wallAt(2.0, 0.15, origin, direction));
  });
  std::vector<Beam> beams;
  for (double direction = -0.5; direction <= 0.5; direction += 0.01)
    beams.push_back({direction, 3.0, true, 0.0});
  for (int i = 0; i < 10; ++i) map_.addScan(time_s_ += 0.1, beams, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(occupied(1.9, 2.1, 0.0));
  EXPECT_TRUE(occupied(2.95, 3.05, 0.0)) << "what the laser met";
}

TEST_F(ObstacleMapTest, TakesARangeFinderAcrossItsBeam) {
  for (int i = 0; i < 3; ++i)
    map_.addRange(time_s_ += 0.1, {0.0, 2.0, true, 0.1}, Eigen::Isometry3d::Identity());
  for (double y = -0.15; y <= 0.15; y += 0.05) EXPECT_TRUE(occupied(1.9, 2.05, y)) << y;
  EXPECT_FALSE(occupied(1.9, 2.05, 0.4));
  EXPECT_EQ(value(1.0, 0.0), grid::kFree);
  EXPECT_EQ(value(2.5, 0.0), grid::kUnknown) << "behind it";
}

TEST_F(ObstacleMapTest, FollowsTheRobotWithoutMovingTheCells) {
  for (int i = 0; i < 3; ++i)
    map_.addRange(time_s_ += 0.1, {0.0, 2.0, true, 0.0}, Eigen::Isometry3d::Identity());
  map_.follow({1.03, -0.52});
  EXPECT_TRUE(occupied(1.95, 2.05, 0.0));
  const auto& geometry = map_.grid().geometry;
  EXPECT_NEAR(geometry.origin_x_m + 0.5 * geometry.width * geometry.resolution_m, 1.03, 0.06);
}

}  // namespace
}  // namespace stereo_nav::navigation
