#include "mapping/map/world_alignment.h"

#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav::mapping {
namespace {

TEST(AlignWithWorld, ReportsWhatRemainsOfEachPair) {
  // A square of 10 m, one corner of which was measured 4 cm too high.
  std::vector<WorldPair> pairs;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}})
    pairs.push_back({{x, y, 0.0}, {100.0 - y, 50.0 + x, 3.0}});
  pairs[0].p_world.z() += 0.04;
  const WorldTransform level = alignWithWorld(pairs, {false, true});
  EXPECT_NEAR(level.residuals_m[0], 0.03, 1e-12);
  EXPECT_NEAR(level.residuals_m[2], 0.01, 1e-12);
  EXPECT_NEAR(level.rms_m, std::sqrt((0.03 * 0.03 + 3 * 0.01 * 0.01) / 4.0), 1e-12);
  EXPECT_TRUE((level.T_world_map * Eigen::Vector3d(5, 5, 0)).isApprox(Eigen::Vector3d(95, 55, 3.01), 1e-9));
  // Free to tilt, the map follows the corner as far as the other three let it.
  EXPECT_NEAR(alignWithWorld(pairs, {false, false}).residuals_m[0], 0.01, 1e-4);
}

TEST(AlignWithWorld, SaysWhatLeavesTheTransformOpen) {
  const std::vector<WorldPair> line = {
      {{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {2, 0, 0}}};
  EXPECT_NE(messageOf<InputError>([&] {
              alignWithWorld({line[0], line[1]}, {});
            }).find("at least 3"),
            std::string::npos);
  EXPECT_NE(messageOf<InputError>([&] { alignWithWorld(line, {}); }).find("on a line"), std::string::npos);
  EXPECT_NO_THROW(alignWithWorld(line, {true, true}));
  const std::vector<WorldPair> tower = {
      {{1, 2, 0}, {0, 0, 0}}, {{1, 2, 1}, {0, 0, 1}}, {{1, 2, 5}, {0, 0, 5}}};
  EXPECT_NE(messageOf<InputError>([&] {
              alignWithWorld(tower, {true, true});
            }).find("seen from above"),
            std::string::npos);
}

TEST(AlignWithWorld, ReadsPairsFromAFile) {
  const TemporaryFolder folder;
  const auto pairs = readWorldPairs(folder.write("pairs.txt", "# map, world\n0 0 0 1 2 3\n1,0,0,1,3,3\n"));
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[1].p_world, Eigen::Vector3d(1, 3, 3));
  EXPECT_NE(messageOf<InputError>([&] {
              readWorldPairs(folder.write("short.txt", "0 0 0 1 2\n"));
            }).find(":1: 5 numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::mapping
