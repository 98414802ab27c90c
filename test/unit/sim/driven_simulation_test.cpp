// A robot that is driven: what its sensors say is held against what is known of its world and its way.
#include "sim/driven_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planar_motion.h"
#include "kinematics/layouts.h"
#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

using kinematics::DriveParams;
using kinematics::Twist;

/// Keeps all that is delivered.
struct Recorder : DrivenSink {
  void takeTicks(const SimulatedTicks& reading, const BaseState& state) override {
    ticks.push_back(reading);
    truth.push_back(planarPart(state.T_world_base));
  }
  void takeImu(const ImuSample& sample) override { imu.push_back(sample); }
  void takeScan(const laser::Scan& scan) override { scans.push_back(scan); }
  void takeRange(std::size_t, double, double range_m) override { ranges_m.push_back(range_m); }
  void takeShot(StereoShot shot) override { shots.push_back(std::move(shot)); }
  void takeContacts(double, const std::vector<std::string>& names) override { contacts.push_back(names); }

  std::vector<SimulatedTicks> ticks;
  std::vector<Eigen::Isometry2d> truth;  ///< at the times of the ticks
  std::vector<ImuSample> imu;
  std::vector<laser::Scan> scans;
  std::vector<double> ranges_m;
  std::vector<StereoShot> shots;
  std::vector<std::vector<std::string>> contacts;
};

/// No errors, few images, counters that are read each millisecond.
Scenario drivenScenario() {
  Scenario scenario = cleanScenario();
  scenario.timing.rate_hz = 2.0;
  scenario.driven.longest_s = 20.0;
  scenario.wheels.rate_hz = 1000.0;
  scenario.laser.noise_m = scenario.laser.dropout = scenario.range.noise_m = 0.0;
  return scenario;
}

DrivenRig rigWith(DriveParams drive) {
  DrivenRig rig;
  for (auto& wheel : drive.wheels) wheel.pulses_per_turn = 1e6;
  rig.drive = drive;
  rig.cmd_vel_timeout_s = 100.0;
  return rig;
}

void drive(DrivenSimulation& simulation, const Twist& twist, double duration_s, Recorder& recorder) {
  simulation.command(twist);
  simulation.advance(simulation.time_s() + duration_s, recorder);
}

/// The way by the pulses of wheels of this geometry.
Eigen::Isometry2d wayBy(const Recorder& recorder, const DriveParams& params) {
  const kinematics::Drive drive(params);
  Eigen::Isometry2d way = Eigen::Isometry2d::Identity();
  for (std::size_t k = 1; k < recorder.ticks.size(); ++k) {
    std::vector<kinematics::WheelState> wheels(drive.size());
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const auto pulses = recorder.ticks[k].pulses[i] - recorder.ticks[k - 1].pulses[i];
      wheels[i].speed_m_per_s = static_cast<double>(pulses) * params.wheels[i].metresPerPulse();
      if (recorder.ticks[k].steering_rad.empty()) continue;
      wheels[i].steering_rad =
          0.5 * (recorder.ticks[k].steering_rad[i] + recorder.ticks[k - 1].steering_rad[i]);
    }
    way = way * expPlanar(drive.forward(wheels).twist);
  }
  return way;
}

double endError_m(const Recorder& recorder, const DriveParams& params) {
  return (wayBy(recorder, params).translation() - recorder.truth.back().translation()).norm();
}

TEST(DrivenSimulation, pulsesIntegrateToTheTrueWayWithEveryDrive) {
  for (const DriveParams& layout :
       {kinematics::differentialDrive(0.32, 0.033), kinematics::mecanumDrive(0.15, 0.12, 0.05),
        kinematics::omniDrive(3, 0.2, 60.0, 0.05), kinematics::ackermannDrive(0.3, 0.25, 30.0, 0.05),
        kinematics::swerveDrive({{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}, 0.05)}) {
    Scenario scenario = drivenScenario();
    scenario.wheels.radius_sigma = 0.01;
    const DrivenRig rig = rigWith(layout);
    DrivenSimulation simulation(scenario, rig, thesisRig(), 3);
    Recorder recorder;
    drive(simulation, {0.4, 0.0, 0.3}, 2.0, recorder);
    drive(simulation, {0.3, 0.2, -0.5}, 2.0, recorder);
    EXPECT_GT(recorder.truth.back().translation().norm(), 0.8);
    EXPECT_LT(endError_m(recorder, simulation.trueWheels()), 1e-3);
    EXPECT_GT(endError_m(recorder, rig.drive), 1e-3) << "the radii are those of the rig file";
    EXPECT_TRUE(recorder.contacts.empty());
  }
}

TEST(DrivenSimulation, slipPartsTheWayFromThePulses) {
  Scenario scenario = drivenScenario();
  scenario.wheels.slip_sigma_m = 0.02;
  DrivenSimulation simulation(scenario, rigWith(kinematics::differentialDrive(0.32, 0.033)), thesisRig(), 3);
  Recorder recorder;
  drive(simulation, {0.4, 0.0, 0.3}, 4.0, recorder);
  EXPECT_GT(endError_m(recorder, simulation.trueWheels()), 0.005);
}

TEST(DrivenSimulation, theBaseObeysItsLimitsAndStopsWhenCommandsCease) {
  DrivenRig rig = rigWith(kinematics::differentialDrive(0.32, 0.033));
  rig.cmd_vel_timeout_s = 0.3;
  rig.limits.max_acceleration_m_per_s2 = 1.0;
  rig.limits.max_speed_m_per_s = 0.4;
  DrivenSimulation simulation(drivenScenario(), rig, thesisRig(), 1);
  Recorder recorder;
  drive(simulation, {2.0, 0.0, 0.0}, 0.2, recorder);
  EXPECT_LE(simulation.state().velocity_base.x(), 0.2);
  EXPECT_GT(simulation.state().velocity_base.x(), 0.1);
  for (int i = 0; i < 10; ++i) drive(simulation, {2.0, 0.0, 0.0}, 0.1, recorder);
  EXPECT_NEAR(simulation.state().velocity_base.x(), 0.4, 1e-3);
  simulation.advance(simulation.time_s() + 1.5, recorder);
  EXPECT_NEAR(simulation.state().velocity_base.x(), 0.0, 1e-3);
}

/// Somebody walks 2 m through the place where the robot is.
Scenario walkerScenario(double waits_m) {
  Scenario scenario = drivenScenario();
  ObjectParams walker;
  walker.name = "walker";
  walker.shape = Shape::kCylinder;
  walker.length_m = 0.4;
  walker.height_m = 1.7;
  walker.y_m = 1.5;
  walker.walk_y_m = -3.0;
  walker.walk_period_s = 6.0;
  walker.waits_m = waits_m;
  scenario.scene.objects = {walker};
  return scenario;
}

TEST(DrivenSimulation, whoWaitsStopsBeforeARobotThatStandsAndGoesOnWhenItIsGone) {
  const DrivenRig rig = rigWith(kinematics::differentialDrive(0.32, 0.033));
  DrivenSimulation simulation(walkerScenario(0.5), rig, thesisRig(), 1);
  Recorder recorder;
  simulation.advance(6.0, recorder);
  EXPECT_TRUE(recorder.contacts.empty());
  // Half the robot's width, the walker's radius, and half a metre between them.
  EXPECT_NEAR(simulation.scene().solids().back().position(6.0).y(), 0.2 + 0.2 + 0.5, 0.01);
  double nearest_m = 10.0;
  for (int i = 0; i < 12; ++i) {
    drive(simulation, {0.5, 0.0, 0.0}, 0.5, recorder);
    nearest_m = std::min(nearest_m, simulation.scene().solids().back().position(simulation.time_s()).y());
  }
  EXPECT_LT(nearest_m, -1.0) << "the way is free";

  DrivenSimulation heedless(walkerScenario(0.0), rig, thesisRig(), 1);
  heedless.advance(6.0, recorder);
  EXPECT_FALSE(recorder.contacts.empty());
}

/// Distance from a point in a room of 6 x 4 m about the origin to its walls, along a direction.
double toWalls(const Eigen::Vector2d& from, double angle_rad) {
  const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double wall = std::copysign(axis == 0 ? 3.0 : 2.0, direction[axis]);
    if (std::abs(direction[axis]) > 1e-12)
      nearest_m = std::min(nearest_m, (wall - from[axis]) / direction[axis]);
  }
  return nearest_m;
}

TEST(DrivenSimulation, everyBeamMeasuresKnownWallsFromWhereTheLaserIsAtItsTime) {
  Scenario scenario = drivenScenario();
  RoomParams& room = scenario.scene.room;
  room.x_min_m = -3.0, room.x_max_m = 3.0, room.y_min_m = -2.0, room.y_max_m = 2.0;
  DrivenRig rig = rigWith(kinematics::differentialDrive(0.32, 0.033));
  rig.lasers.resize(1);
  rig.lasers[0].T_base_laser.translation() << 0.1, 0.05, 0.3;
  rig.lasers[0].T_base_laser.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  rig.ranges.resize(1);
  rig.ranges[0].T_base_sensor.translation().z() = 0.3;
  rig.ranges[0].field_of_view_rad = 0.0;
  DrivenSimulation simulation(scenario, rig, thesisRig(), 1);
  Recorder recorder;
  drive(simulation, {0.0, 0.0, 0.0}, 0.1, recorder);
  EXPECT_NEAR(recorder.ranges_m.front(), 3.0, 1e-3);
  drive(simulation, {0.4, 0.0, 1.0}, 1.9, recorder);
  ASSERT_EQ(recorder.scans.size(), 20u);
  for (const laser::Scan& scan : recorder.scans) {
    ASSERT_EQ(scan.ranges_m.size(), 360u);
    for (std::size_t beam = 0; beam < 360; ++beam) {
      const double time_s = scan.time_s + static_cast<double>(beam) * scan.time_increment_s;
      const auto tick = static_cast<std::size_t>(std::floor(1e3 * time_s + 1e-6));
      ASSERT_NEAR(recorder.ticks[tick].time_s, time_s, 1.1e-3);
      const Eigen::Isometry2d rest = recorder.truth[tick].inverse() * recorder.truth[tick + 1];
      const double share = (time_s - recorder.ticks[tick].time_s) * 1e3;
      const Eigen::Isometry2d base = recorder.truth[tick] * expPlanar(share * logPlanar(rest));
      const double angle_rad = yawOf(base) + 1.0 - 2.0 * M_PI * static_cast<double>(beam) / 360.0;
      ASSERT_NEAR(scan.ranges_m[beam], toWalls(base * Eigen::Vector2d(0.1, 0.05), angle_rad), 1e-3)
          << "beam " << beam << " at " << time_s;
    }
  }
}

TEST(DrivenSimulation, itStopsAtAWallWhileItsWheelsTurnAndComesFreeAgain) {
  Scenario scenario = drivenScenario();
  ObjectParams wall;
  wall.name = "post";
  wall.shape = Shape::kCylinder;
  wall.length_m = 0.2;
  wall.x_m = 1.1;
  ObjectParams mat = wall;
  mat.x_m = 0.0;
  mat.height_m = 0.01;
  scenario.scene.objects = {wall, mat};
  DrivenSimulation simulation(scenario, rigWith(kinematics::differentialDrive(0.32, 0.033)), thesisRig(), 1);
  Recorder recorder;
  drive(simulation, {0.5, 0.0, 0.0}, 3.0, recorder);
  EXPECT_NEAR(simulation.state().T_world_base.translation().x(), 1.0 - 0.25, 1e-3);
  ASSERT_EQ(recorder.contacts.size(), 1u);
  EXPECT_EQ(recorder.contacts[0], std::vector<std::string>{"post"});
  EXPECT_GT(wayBy(recorder, simulation.trueWheels()).translation().x(), 1.2);
  drive(simulation, {-0.5, 0.0, 0.0}, 1.0, recorder);
  EXPECT_LT(simulation.state().T_world_base.translation().x(), 0.5);
  ASSERT_EQ(recorder.contacts.size(), 2u);
  EXPECT_TRUE(recorder.contacts[1].empty());
}

TEST(DrivenSimulation, aBoxIsPushedUntilItStandsAtTheWall) {
  Scenario scenario = drivenScenario();
  scenario.scene.room.x_max_m = 2.0;
  ObjectParams box;
  box.name = "box";
  box.movable = true;
  box.length_m = box.width_m = 0.3;
  box.x_m = 0.8;
  scenario.scene.objects = {box};
  DrivenSimulation simulation(scenario, rigWith(kinematics::differentialDrive(0.32, 0.033)), thesisRig(), 1);
  Recorder recorder;
  drive(simulation, {0.5, 0.0, 0.0}, 2.0, recorder);
  const double front_m = simulation.state().T_world_base.translation().x() + 0.25;
  EXPECT_GT(front_m, 0.9);
  EXPECT_NEAR(simulation.scene().solids()[1].p_world.x(), front_m + 0.15, 1e-3);
  drive(simulation, {0.5, 0.0, 0.0}, 2.0, recorder);
  EXPECT_NEAR(simulation.scene().solids()[1].p_world.x(), 2.0 - 0.15, 1e-3);
  EXPECT_NEAR(simulation.state().T_world_base.translation().x(), 2.0 - 0.3 - 0.25, 2e-3);
}

TEST(DrivenSimulation, whatAppearsIsMeasuredFromThenOn) {
  Scenario scenario = drivenScenario();
  ObjectParams box;
  box.x_m = 2.0;
  box.from_s = 1.0;
  scenario.scene.objects = {box};
  DrivenRig rig = rigWith(kinematics::differentialDrive(0.32, 0.033));
  rig.ranges.resize(1);
  rig.ranges[0].T_base_sensor.translation().z() = 0.2;
  DrivenSimulation simulation(scenario, rig, thesisRig(), 1);
  Recorder recorder;
  drive(simulation, {0.0, 0.0, 0.0}, 1.5, recorder);
  EXPECT_NEAR(recorder.ranges_m.front(), 0.2 / std::sin(0.03), 0.01) << "its cone meets the floor";
  EXPECT_NEAR(recorder.ranges_m.back(), 1.75, 1e-3);
}

TEST(DrivenSimulation, aRobotAtRestSeesWhatTheScriptedOneSees) {
  Scenario scenario = loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml",
                                   {"rig.samples_per_pixel=1", "timing.rate_hz=10"});
  scenario.driven.longest_s = 1.0;
  const Simulation scripted(scenario, thesisRig(), 5);
  DrivenSimulation driven(scenario, rigWith(kinematics::differentialDrive(0.32, 0.033)), thesisRig(), 5);
  Recorder recorder;
  driven.advance(0.3, recorder);
  ASSERT_GE(recorder.shots.size(), 2u);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const cv::Mat image = recorder.shots[1].image(side, *driven.cameras());
    EXPECT_EQ(cv::norm(image, scripted.image(side, 1), cv::NORM_INF), 0.0);
  }
}

TEST(DrivenSimulation, theImuFeelsTheMotionAndTheSameCommandsGiveTheSameAgain) {
  Scenario scenario = drivenScenario();
  scenario.wheels.slip_sigma_m = 0.01;
  Recorder first, second;
  for (Recorder* recorder : {&first, &second}) {
    DrivenSimulation simulation(scenario, rigWith(kinematics::differentialDrive(0.32, 0.033)), thesisRig(),
                                7);
    drive(simulation, {0.4, 0.0, 0.5}, 1.0, *recorder);
    drive(simulation, {0.2, 0.0, -0.5}, 1.0, *recorder);
  }
  ASSERT_EQ(first.ticks.size(), second.ticks.size());
  for (std::size_t i = 0; i < first.ticks.size(); ++i) {
    EXPECT_EQ(first.ticks[i].pulses, second.ticks[i].pulses);
    EXPECT_EQ(first.truth[i].matrix(), second.truth[i].matrix());
  }
  ASSERT_EQ(first.imu.size(), 201u);
  const ImuSample& sample = first.imu[90];
  EXPECT_NEAR(sample.angular_velocity->z(), 0.5, 0.15);
  EXPECT_NEAR(sample.linear_acceleration->z(), 9.81, 1e-9);
  EXPECT_EQ(*sample.angular_velocity, *second.imu[90].angular_velocity);
}

}  // namespace
}  // namespace stereo_nav::sim
