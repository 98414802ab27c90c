#include "sim/map_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid/map_file.h"
#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

TEST(MapWalls, rectanglesCoverExactlyTheObstacles) {
  cv::Mat_<std::uint8_t> mask(20, 30);
  cv::theRNG().state = 5;
  cv::randu(mask, 0, 2);
  mask(cv::Rect(3, 4, 10, 6)) = 1;
  cv::Mat covered = cv::Mat::zeros(mask.size(), CV_8UC1);
  for (const cv::Rect& cells : rectanglesOf(mask)) covered(cells) += cv::Scalar(1);
  EXPECT_EQ(cv::norm(covered, cv::Mat(mask), cv::NORM_INF), 0.0);
  EXPECT_EQ(rectanglesOf(cv::Mat_<std::uint8_t>(5, 7, std::uint8_t{1})).size(), 1u);
}

TEST(MapWalls, aRayMeetsTheFirstOccupiedCellOfTheMap) {
  const std::string map_file = STEREO_NAV_SOURCE_DIR "/test/rostest/hall.yaml";
  const grid::OccupancyGrid map = grid::loadMap(map_file);
  const Scenario scenario = loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/standstill.yaml",
                                         {"map_walls.file=" + map_file, "map_walls.height_m=3"});
  SceneParams walls_alone = scenario.scene;
  walls_alone.clutter.clear();
  auto& objects = walls_alone.objects;
  objects.erase(std::remove_if(objects.begin(), objects.end(),
                               [](const ObjectParams& object) { return object.name != "wall of the map"; }),
                objects.end());
  const Scene scene(walls_alone);
  const grid::Cell start{40, 40};
  ASSERT_EQ(map.at(start), grid::kFree);
  int steps = 0;
  while (map.at({start.x + steps, start.y}) < grid::kObstacleFrom) ++steps;
  const Eigen::Vector2d from = map.geometry.centreOf(start);
  const double distance_m = scene.castRay({from.x(), from.y(), 0.5}, Eigen::Vector3d::UnitX(), 0.0);
  EXPECT_NEAR(distance_m, (steps - 0.5) * map.geometry.resolution_m, 1e-5);
}

}  // namespace
}  // namespace stereo_nav::sim
