#include "mapping/map/map_file.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "mapping/map/edge_error.h"
#include "stereo_nav/core/input_error.h"
#include "support/damaged_bytes.h"
#include "support/trajectories.h"
#include "unit/mapping/map/map_scene.h"

namespace stereo_nav::mapping {
namespace {

TEST(MapFile, GivesTheSameBytesAfterLoading) {
  const TemporaryFolder folder;
  saveMap(smallMap(), folder / "first.map");
  const VisualMap loaded = loadMap(folder / "first.map");
  saveMap(loaded, folder / "second.map");
  EXPECT_EQ(folder.read("first.map"), folder.read("second.map"));
  EXPECT_EQ(folder.countFiles(), 2U);

  const VisualMap map = smallMap();
  ASSERT_EQ(loaded.keyframes.size(), map.keyframes.size());
  EXPECT_EQ(loaded.keyframes[3].T_map_camera.matrix(), map.keyframes[3].T_map_camera.matrix());
  EXPECT_EQ(loaded.keyframes[3].keyframe.descriptors, map.keyframes[3].keyframe.descriptors);
  EXPECT_EQ(loaded.keyframes[3].keyframe.covariance, map.keyframes[3].keyframe.covariance);
  EXPECT_NEAR(loaded.keyframes[3].keyframe.corners[2].px.x(), map.keyframes[3].keyframe.corners[2].px.x(),
              1e-5);
  EXPECT_FALSE(loaded.keyframes[4].keyframe.follows);
  EXPECT_EQ(loaded.landmarks[5].p_map, map.landmarks[5].p_map);
  EXPECT_EQ(loaded.loops[0].to_id, 20U);
  ASSERT_TRUE(loaded.world);
  EXPECT_EQ(loaded.world->T_world_map.scale, map.world->T_world_map.scale);
  EXPECT_EQ(loaded.world->residuals_m, map.world->residuals_m);
}

TEST(MapFile, HoldsAnEmptyMap) {
  const std::string bytes = toBytes(VisualMap());
  EXPECT_EQ(toBytes(mapOfBytes(bytes, "empty.map")), bytes);
}

/// STEREO_NAV_DAMAGED_FILES says how many; docs/mapping.md.
TEST(MapFile, RefusesDamagedFilesWithTheSectionNamed) {
  const char* asked = std::getenv("STEREO_NAV_DAMAGED_FILES");
  const int files = asked == nullptr ? 1000 : std::atoi(asked);
  const std::string whole = toBytes(smallMap());
  std::mt19937 generator(1);
  for (int i = 0; i < files; ++i) {
    const std::string bytes = test::damaged(whole, generator);
    if (bytes == whole) continue;
    const std::string error = messageOf<InputError>([&] { mapOfBytes(bytes, "hall.map"); });
    EXPECT_TRUE(error.find("section '") != std::string::npos || error.find(": head: ") != std::string::npos ||
                error.find("does not begin as a map does") != std::string::npos)
        << "damage " << i << ": " << error;
  }
}

TEST(MapFile, NamesTheSectionThatIsDamaged) {
  std::string bytes = toBytes(smallMap());
  bytes[bytes.size() - 20] ^= 1;
  const std::string error = messageOf<InputError>([&] { mapOfBytes(bytes, "hall.map"); });
  EXPECT_NE(error.find("hall.map: section 'world': its checksum is wrong"), std::string::npos) << error;
}

TEST(MapFile, RefusesWhatContradictsItself) {
  VisualMap map = smallMap();
  map.loops[0].to_id = 11;
  EXPECT_NE(messageOf<InputError>([&] {
              mapOfBytes(toBytes(map), "m");
            }).find("section 'loops': a loop with a keyframe"),
            std::string::npos);
  map = smallMap();
  map.keyframes[2].keyframe.id = 10;
  EXPECT_NE(messageOf<InputError>([&] { mapOfBytes(toBytes(map), "m"); }).find("section 'keyframes': ids"),
            std::string::npos);
  map = smallMap();
  map.landmarks[1].p_map.x() = NAN;
  EXPECT_NE(
      messageOf<InputError>([&] { mapOfBytes(toBytes(map), "m"); }).find("section 'landmarks': a number"),
      std::string::npos);
  map = smallMap();
  map.keyframes[1].T_map_camera.linear() *= 1.01;
  EXPECT_NE(messageOf<InputError>([&] { mapOfBytes(toBytes(map), "m"); }).find("not at right angles"),
            std::string::npos);
}

TEST(VisualMap, IsAGraphWhoseOdometryFits) {
  const VisualMap map = smallMap();
  const SpatialGraph graph = graphOf(map);
  ASSERT_EQ(graph.edges.size(), 4U + 1U);  // not before the first keyframe and the new start
  for (std::size_t e = 0; e < 4; ++e) EXPECT_LT(chiSquare(graph, graph.edges[e]), 1e-12);
  EXPECT_NEAR(chiSquare(graph, graph.edges[4]), 0.1 * 0.1 / 1e-4, 1e-6);
}

TEST(VisualMap, CountsAnglesNotTheirHalves) {
  VisualMap map = smallMap();
  map.loops[0].T_from_to = map.keyframes[0].T_map_camera.inverse() * map.keyframes[5].T_map_camera *
                           Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX());
  const SpatialGraph graph = graphOf(map);
  EXPECT_NEAR(chiSquare(graph, graph.edges[4]), 0.02 * 0.02 / 1e-4, 1e-3);
}

TEST(VisualMap, KnowsItsCalibration) {
  vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = 400.0;
  calibration.baseline_m = 0.1;
  VisualMap map;
  map.calibration_hash = calibrationHash(calibration);
  EXPECT_NO_THROW(requireCalibration(map, calibration));
  calibration.baseline_m = 0.1001;
  EXPECT_THROW(requireCalibration(map, calibration), InputError);
}

}  // namespace
}  // namespace stereo_nav::mapping
