#include "sim/mirror.h"

#include <gtest/gtest.h>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

/// A plain room without texture: floor 0.2, walls 0.4, ceiling 0.8.
Scenario plainRoom() {
  Scenario scenario = cleanScenario();
  RoomParams& room = scenario.scene.room;
  for (Material* material : {&room.floor, &room.walls, &room.ceiling}) material->contrast = 0.0;
  room.floor.brightness = 0.2;
  room.walls.brightness = 0.4;
  room.ceiling.brightness = 0.8;
  return scenario;
}

cv::Mat leftImage(const Scenario& scenario) {
  return Simulation(scenario, thesisRig(), 1).image(Side::kLeft, 0);
}

/// Direction of a raw pixel of the left camera in the world.
Eigen::Vector3d rayOf(const Scenario& scenario, int x, int y) {
  const Simulation simulation(scenario, thesisRig(), 1);
  const Eigen::Vector2d ray = simulation.calibration(Side::kLeft).undistort(Eigen::Vector2d(x, y));
  return (simulation.cameraPose(Side::kLeft, 0.0).linear() * ray.homogeneous()).normalized();
}

TEST(Mirror, ReflectsAboutItsPlane) {
  Mirror mirror;
  mirror.T_world_mirror.translation() << 1.0, 2.0, 3.0;
  EXPECT_TRUE(
      (mirror.reflection() * Eigen::Vector3d(5.0, 6.0, 4.0)).isApprox(Eigen::Vector3d(5.0, 6.0, 2.0)));
  EXPECT_DOUBLE_EQ(mirror.side({0.0, 0.0, 4.5}), 1.5);
}

TEST(Mirror, MirrorsMoreAtASlant) {
  EXPECT_FLOAT_EQ(mirroredShare(0.04f, 1.0f), 0.04f);
  EXPECT_FLOAT_EQ(mirroredShare(0.04f, 0.0f), 1.0f);
  EXPECT_NEAR(mirroredShare(0.04f, 0.5f), 0.04 + 0.96 / 32.0, 1e-6);
}

TEST(Mirror, AGlossyFloorShowsTheWallAheadUpsideDown) {
  Scenario scenario = plainRoom();
  const int x = 160, y = 200;
  const double floor = 0.2 * 255.0, wall = 0.4 * 255.0 * 0.82;
  ASSERT_NEAR(leftImage(scenario).at<uchar>(y, x), floor, 1.0);
  scenario.scene.room.floor_gloss = 0.04;
  const double share = mirroredShare(0.04f, static_cast<float>(-rayOf(scenario, x, y).z()));
  ASSERT_GT(share, 0.1);  // far from straight down
  const uchar seen = leftImage(scenario).at<uchar>(y, x);
  const double front = (1.0 - share) * floor + share * wall;
  const double lit = (1.0 - share) * floor + share * wall * 0.95 / 0.82;
  EXPECT_GE(seen, std::min(front, lit) - 1.0);
  EXPECT_LE(seen, std::max(front, lit) + 1.0);
}

TEST(Mirror, ALampShowsInAGlossyFloorAndNotInAMattOne) {
  Scenario scenario = plainRoom();
  ObjectParams lamp;
  lamp.x_m = 8.0;
  lamp.width_m = 4.0;
  lamp.length_m = 0.5;
  lamp.height_m = 0.1;
  lamp.bottom_m = 1.0;
  lamp.material.contrast = 0.0;
  lamp.material.brightness = 8.0;
  scenario.scene.objects = {lamp};
  const auto brightestOfFloor = [](const cv::Mat& image) {
    double brightest = 0.0;
    cv::minMaxLoc(image.rowRange(150, 240), nullptr, &brightest);
    return brightest;
  };
  EXPECT_NEAR(brightestOfFloor(leftImage(scenario)), 0.2 * 255.0, 1.0);
  scenario.scene.room.floor_gloss = 0.04;
  EXPECT_GT(brightestOfFloor(leftImage(scenario)), 200.0);
  // What stands between the floor and the lamp hides its image.
  ObjectParams box = lamp;
  box.x_m = 7.0;
  box.bottom_m = 0.0;
  box.height_m = 3.0;
  box.width_m = 12.0;
  box.material.brightness = 0.2;
  scenario.scene.objects = {lamp, box};
  EXPECT_LT(brightestOfFloor(leftImage(scenario)), 60.0);
}

TEST(Mirror, APaneShowsWhatIsBehindItAndMirrorsTheRoom) {
  Scenario scenario = plainRoom();
  ObjectParams wall = wallAhead(3.0, TextureKind::kPlain);
  wall.material.contrast = 0.0;
  wall.material.brightness = 0.8;
  ObjectParams pane = wallAhead(2.0, TextureKind::kPlain);
  pane.length_m = 0.01;
  pane.glass = true;
  scenario.scene.objects = {wall};
  const uchar without = leftImage(scenario).at<uchar>(60, 160);
  scenario.scene.objects = {wall, pane};
  // 8 % of the wall behind the robot, which is dark, in place of as much of the wall ahead.
  const double ahead = 0.8 * 255.0 * 0.95;
  ASSERT_NEAR(without, ahead, 1.0);
  const uchar with = leftImage(scenario).at<uchar>(60, 160);
  EXPECT_GE(with, 0.92 * ahead + 0.08 * 0.4 * 255.0 * 0.82 - 1.5);
  EXPECT_LE(with, 0.92 * ahead + 0.08 * 0.4 * 255.0 * 0.95 + 1.5);
  // No ray of the truth stops at it.
  EXPECT_NEAR(Scene(scenario.scene).castRay({0.1, 0.0, 0.5}, {1.0, 0.0, 0.0}, 0.0), 3.0, 1e-6);
}

TEST(Mirror, RepeatedObjectsLookAlike) {
  SceneParams params;
  ObjectParams door;
  door.material.texture = TextureKind::kWood;
  door.repeats = 3;
  door.repeat_x_m = 2.0;
  params.objects = {door, door};
  const Scene scene(params);
  ASSERT_EQ(scene.solids().size(), 7u);  // with the room
  EXPECT_EQ(scene.solids()[3].p_world.x() - scene.solids()[1].p_world.x(), 4.0);
  EXPECT_EQ(scene.solids()[3].sides.u_offset, scene.solids()[1].sides.u_offset);
  EXPECT_NE(scene.solids()[4].sides.u_offset, scene.solids()[1].sides.u_offset);
}

}  // namespace
}  // namespace stereo_nav::sim
