// `map_info` as its users run it.
#include "stereo_nav/core/trajectory.h"
#include "support/command.h"
#include "support/trajectories.h"
#include "unit/mapping/map/graph_scene.h"
#include "unit/mapping/map/map_scene.h"

namespace stereo_nav::mapping {
namespace {

class MapInfoProgram : public ::testing::Test {
 protected:
  MapInfoProgram() {
    VisualMap map = smallMap();
    map.world.reset();
    saveMap(map, folder_ / "hall.map");
  }
  test::CommandResult mapInfo(const std::string& arguments) const {
    return test::runCommand("cd " + folder_.path() + " && " + MAP_INFO + " hall.map " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_F(MapInfoProgram, PrintsAndExports) {
  const auto result = mapInfo("--tum hall.tum --g2o hall.g2o --ply hall.ply");
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("6 keyframes with 48 corners and 96 descriptors"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("1 loops, of which 1 are kept"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("not set in the world"), std::string::npos) << result.output;
  EXPECT_EQ(readTum(folder_ / "hall.tum").size(), 6U);
  EXPECT_EQ(std::get<SpatialGraph>(readG2o(folder_ / "hall.g2o")).edges.size(), 5U);
  EXPECT_NE(folder_.read("hall.ply").find("element vertex 19"), std::string::npos);
}

TEST_F(MapInfoProgram, SetsTheWorld) {
  EXPECT_EQ(mapInfo("--tum hall.tum --in-world").status, 2);
  folder_.write("pairs.txt", "0 0 0 100 200 5\n1 0 0 100 201 5\n0 1 0 99 200 5\n");
  const auto result =
      mapInfo("--set-world pairs.txt --level --scale --save world.map --tum hall.tum --in-world");
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("turned by 90.000 deg"), std::string::npos) << result.output;
  ASSERT_TRUE(loadMap(folder_ / "world.map").world);
  const Eigen::Vector3d first = readTum(folder_ / "hall.tum")[0].T_world_body.translation();
  EXPECT_TRUE(first.isApprox(Eigen::Vector3d(100, 200, 5), 1e-6));
  EXPECT_FALSE(loadMap(folder_ / "hall.map").world);
}

}  // namespace
}  // namespace stereo_nav::mapping
