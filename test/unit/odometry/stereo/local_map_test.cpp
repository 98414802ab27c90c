#include "odometry/stereo/local_map.h"

#include <gtest/gtest.h>

#include "support/textured_room.h"
#include "synthetic_map.h"

namespace stereo_nav::odometry {
namespace {

class LocalMapTest : public ::testing::Test {
 protected:
  static WindowFrame frameAt(double z_m) {
    WindowFrame frame;
    frame.view.T_camera_world.translation().z() = -z_m;
    return frame;
  }

  /// A landmark at `p_world`, seen first by the newest frame, which stands at the origin.
  std::uint64_t addPoint(const Eigen::Vector3d& p_world) {
    Landmark landmark;
    landmark.ray_depth = {p_world.x() / p_world.z(), p_world.y() / p_world.z(), 1.0 / p_world.z()};
    return map.addLandmark(landmark, seenBy(map.newest(), p_world));
  }

  vision::StereoObservation seenBy(const WindowFrame& frame, const Eigen::Vector3d& p_world) {
    return test::observe(calibration, frame.view, p_world, 0.0, random);
  }

  vision::StereoCalibration calibration = test::roomCalibration();
  std::mt19937 random{3};
  LocalMap map{3, WindowOptimizerParams(), calibration};
};

TEST_F(LocalMapTest, IsEmptyUntilItStarts) {
  EXPECT_TRUE(map.empty());
  EXPECT_FALSE(map.isAtStart());
  map.start(frameAt(0.0));
  EXPECT_FALSE(map.empty());
  EXPECT_TRUE(map.isAtStart());
  map.addFrame(frameAt(0.1));
  EXPECT_FALSE(map.isAtStart());
  EXPECT_EQ(map.newest().view.T_camera_world.translation().z(), -0.1);
  EXPECT_EQ(map.beforeNewest().view.T_camera_world.translation().z(), 0.0);
  map.clear();
  EXPECT_TRUE(map.empty());
}

TEST_F(LocalMapTest, FindsLandmarksByIdsThatAreNeverUsedTwice) {
  map.start(frameAt(0.0));
  EXPECT_EQ(addPoint({0.1, 0.2, 2.0}), 1u);
  EXPECT_EQ(addPoint({-0.3, 0.1, 3.0}), 2u);
  ASSERT_NE(map.find(2), nullptr);
  EXPECT_TRUE(map.find(2)->p_world().isApprox(Eigen::Vector3d(-0.3, 0.1, 3.0)));
  EXPECT_EQ(map.find(3), nullptr);
  map.start(frameAt(0.0));
  EXPECT_EQ(map.find(1), nullptr);
  EXPECT_EQ(addPoint({0.1, 0.2, 2.0}), 3u);
}

TEST_F(LocalMapTest, RemovesAFrameThatIsNoKeyframeWithItsObservations) {
  map.start(frameAt(0.0));
  const std::uint64_t id = addPoint({0.1, 0.2, 2.0});
  map.addFrame(frameAt(0.1));
  map.addObservation(id, seenBy(map.newest(), {0.1, 0.2, 2.0}));
  ASSERT_EQ(map.find(id)->views.size(), 2u);
  map.removeNewest();
  EXPECT_TRUE(map.isAtStart());
  ASSERT_EQ(map.find(id)->views.size(), 1u);
  EXPECT_EQ(map.find(id)->views.front().frame, 0);
}

TEST_F(LocalMapTest, KeepsTheLatestKeyframes) {
  map.start(frameAt(0.0));
  const std::uint64_t id = addPoint({0.1, 0.2, 2.0});
  for (const double z_m : {0.1, 0.2, 0.3, 0.4}) {
    map.addFrame(frameAt(z_m));
    map.addObservation(id, seenBy(map.newest(), {0.1, 0.2, 2.0}));
    map.keepNewest();
  }
  EXPECT_EQ(map.oldest().view.T_camera_world.translation().z(), -0.2);
  const std::vector<LandmarkView>& views = map.find(id)->views;
  ASSERT_EQ(views.size(), 3u);
  for (int f = 0; f < 3; ++f) EXPECT_EQ(views[static_cast<std::size_t>(f)].frame, f);
}

TEST_F(LocalMapTest, RemovesLandmarksThatNeitherAreFollowedNorTieKeyframes) {
  map.start(frameAt(0.0));
  const std::uint64_t lost = addPoint({0.1, 0.2, 2.0});
  const std::uint64_t followed = addPoint({0.3, 0.2, 2.0});
  const std::uint64_t tying = addPoint({-0.2, 0.0, 2.5});
  map.addFrame(frameAt(0.1));
  map.addObservation(tying, seenBy(map.newest(), {-0.2, 0.0, 2.5}));
  map.removeUnused({followed});
  EXPECT_EQ(map.find(lost), nullptr);
  EXPECT_NE(map.find(followed), nullptr);
  EXPECT_NE(map.find(tying), nullptr);
}

TEST_F(LocalMapTest, RefinesTheCurrentFrameToWhereItsObservationsPutIt) {
  map.start(frameAt(0.0));
  const WindowFrame truth = frameAt(0.2);
  std::vector<std::uint64_t> ids;
  const auto points = test::pointsAhead(60, 4);
  for (const Eigen::Vector3d& p : points) ids.push_back(addPoint(p));
  WindowFrame guess = truth;
  guess.view.T_camera_world.translation() += Eigen::Vector3d(0.004, -0.003, 0.005);
  map.addFrame(guess);
  for (std::size_t i = 0; i < points.size(); ++i) map.addObservation(ids[i], seenBy(truth, points[i]));
  for (int i = 0; i < 5; ++i) map.refine();
  EXPECT_LT(logMotion(map.newest().view.T_camera_world * truth.view.T_camera_world.inverse()).norm(), 1e-4);
  EXPECT_TRUE(map.oldest().view.T_camera_world.isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace stereo_nav::odometry
