// A map of a drive of three laps around a room whose odometry drifts; and `build_map` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "import_test_support.h"
#include "mapping/map/map_file.h"
#include "support/command.h"
#include "support/fixture_bag.h"
#include "tools/build_map/map_builder.h"
#include "unit/mapping/loop/landmark_world.h"

namespace stereo_nav::tools {
namespace {

using namespace mapping;  // NOLINT(google-build-using-namespace): the world of the room's own tests

constexpr std::uint32_t kLap = 40, kKeyframes = 3 * kLap;  ///< keyframes

/// Three laps of 6.3 m, on each of which the odometry is 5 cm too long and turns 3 degrees too far.
class MapOfThreeLaps : public ::testing::Test {
 protected:
  MapOfThreeLaps() : builder_(LoopParams(), RobustParams(), testCamera()) {
    LandmarkWorld world(1);
    Vector6d drift;
    drift << 0.0, 0.0, 0.05, 0.0, 0.05, 0.0;
    Eigen::Isometry3d T_odom_camera = onCircle(0.0), before = onCircle(0.0);
    for (std::uint32_t k = 0; k < kKeyframes; ++k) {
      const Eigen::Isometry3d T_world_camera = onCircle(static_cast<double>(k) / kLap);
      vision::Keyframe keyframe = world.seenFrom(T_world_camera, k + 1);
      keyframe.follows = k > 0;
      if (keyframe.follows) {
        keyframe.T_previous_keyframe = before.inverse() * T_world_camera * expMotion(drift / kLap);
        keyframe.covariance = 1e-6 * Matrix6d::Identity();
        T_odom_camera = T_odom_camera * keyframe.T_previous_keyframe;
      }
      before = T_world_camera;
      builder_.add(keyframe, T_odom_camera);
    }
  }

  /// RMS distance of the keyframes from the truth; the first one is at its place.
  double rms_m() const {
    double squares = 0.0;
    for (const MapKeyframe& keyframe : builder_.map().keyframes) {
      const Eigen::Isometry3d truth = onCircle(static_cast<double>(keyframe.keyframe.id - 1) / kLap);
      squares += (keyframe.T_map_camera.translation() - truth.translation()).squaredNorm();
    }
    return std::sqrt(squares / kKeyframes);
  }

  MapBuilder builder_;
};

TEST_F(MapOfThreeLaps, ClosingItsLoopsTakesTheDriftAway) {
  const double before_m = rms_m();
  EXPECT_GT(before_m, 0.08);
  builder_.close();
  EXPECT_GT(builder_.map().loops.size(), kLap);
  EXPECT_EQ(builder_.verdicts().size(), builder_.map().loops.size());
  EXPECT_LT(rms_m(), std::max(0.01, 0.2 * before_m));
}

TEST_F(MapOfThreeLaps, AFalseLoopIsRejectedWithItsReason) {
  builder_.close();
  const double clean_m = rms_m();
  // The robot is said to be in the middle of the second lap where it began.
  VisualMap map = builder_.map();
  map.loops.push_back({1, kLap + kLap / 2, Eigen::Isometry3d::Identity(), 1e-4 * Matrix6d::Identity(), true});
  SpatialGraph graph = graphOf(map);
  const RobustResult result = optimiseRobustly(graph, RobustParams());
  EXPECT_FALSE(result.loops.back().kept);
  EXPECT_FALSE(result.loops.back().reason.empty());
  EXPECT_LT(
      (graph.poses.back().translation() - builder_.map().keyframes.back().T_map_camera.translation()).norm(),
      clean_m + 1e-3);
}

TEST_F(MapOfThreeLaps, LandmarksAreWhereTheBestSightingHasThemAndTheFileHoldsThem) {
  builder_.close();
  const VisualMap& map = builder_.map();
  std::size_t corners = 0;
  for (const MapKeyframe& keyframe : map.keyframes) corners += keyframe.keyframe.corners.size();
  EXPECT_EQ(map.landmarks.size(), corners) << "nobody follows a corner in this world";
  for (std::size_t i = 1; i < map.landmarks.size(); ++i)
    EXPECT_GT(map.landmarks[i].id, map.landmarks[i - 1].id);
  const std::string bytes = toBytes(map);
  EXPECT_EQ(toBytes(mapOfBytes(bytes, "map")), bytes);
}

class BuildMapProgram : public ::testing::Test {
 protected:
  test::CommandResult buildMap(const std::string& arguments) const {
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " + BUILD_MAP + " " +
                            arguments + " --output " + (folder_ / "map"));
  }
  std::string written(const std::string& name) const {
    std::ifstream file(folder_ / ("map/" + name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder folder_;
};

TEST_F(BuildMapProgram, ADriveWithoutLoopsKeepsItsTrajectoryAndTwoRunsGiveTheSameBytes) {
  test::writeFixtureBag(folder_ / "room.bag", {});
  const auto result = buildMap(folder_ / "room.bag");
  ASSERT_EQ(result.status, 0) << result.output;
  const nlohmann::json summary = nlohmann::json::parse(written("summary.json"));
  EXPECT_EQ(summary["loops_accepted"], 0);
  EXPECT_GE(summary["keyframes"], 2);
  EXPECT_GT(summary["landmarks"], 50);
  EXPECT_NEAR(summary["after"]["ate_rmse_m"].get<double>(), summary["before"]["ate_rmse_m"].get<double>(),
              1e-9);
  const std::string map = written("place.map"), list = written("summary.json");
  EXPECT_EQ(mapOfBytes(map, "map").keyframes.size(), summary["keyframes"]);
  ASSERT_EQ(buildMap(folder_ / "room.bag").status, 0);
  EXPECT_EQ(written("place.map"), map);
  EXPECT_EQ(written("summary.json"), list);
}

TEST_F(BuildMapProgram, SaysInOneLineWhatCannotBeUsed) {
  for (const auto& [arguments, said] : {std::pair<std::string, std::string>{"", "no BAG given"},
                                        {folder_ / "absent.bag", "there is no such file"}}) {
    const auto result = buildMap(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_NE(result.output.find(said), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
}

}  // namespace
}  // namespace stereo_nav::tools
