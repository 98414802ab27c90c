#include "tools/simulate/simulated_bag.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "sim_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {
namespace {

sim::Scenario shortScenario() {
  sim::Scenario scenario =
      sim::loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml",
                        {"timing.time_offset_ms=4", "timing.jitter_ms=1", "sensor.rolling_shutter_ms=20"});
  return scenario;
}

void writeBag(const std::string& path, std::uint64_t seed, int threads) {
  const sim::Simulation simulation(shortScenario(), sim::thesisRig(), seed);
  writeSimulatedBag(path, simulation, {0.5, threads, true, false}, [](std::size_t, std::size_t) {});
}

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(SimulatedBag, SameSeedSameBytesOnAnyNumberOfThreads) {
  const std::string folder = testing::TempDir();
  writeBag(folder + "one.bag", 3, 1);
  writeBag(folder + "again.bag", 3, 1);
  writeBag(folder + "two.bag", 3, 2);
  writeBag(folder + "other.bag", 4, 2);
  const std::string one = bytes(folder + "one.bag");
  EXPECT_GT(one.size(), 2000000u);
  EXPECT_TRUE(one == bytes(folder + "again.bag"));
  EXPECT_TRUE(one == bytes(folder + "two.bag"));
  EXPECT_FALSE(one == bytes(folder + "other.bag"));
}

TEST(SimulatedBag, IsARecordingWithTruePairsImuTransformsAndTruth) {
  const std::string path = testing::TempDir() + "recording.bag";
  writeBag(path, 3, 2);
  const ros_io::Recording recording(path, {});
  EXPECT_NEAR(static_cast<double>(recording.pairs()), 16.0, 1.0);  // jitter decides on the last one
  EXPECT_EQ(recording.unpairedImages(), 0u);
  EXPECT_EQ(recording.leftInfo().header.frame_id, "camera_left_optical");
  EXPECT_EQ(recording.rightInfo().header.frame_id, "camera_left_optical");
  EXPECT_NEAR(ros_io::toCalibration(recording.leftInfo(), recording.rightInfo()).baseline_m, 0.1226, 1e-4);
  const auto T_base_camera = recording.transform("base_link", "camera_left_optical");
  ASSERT_TRUE(T_base_camera);
  EXPECT_NEAR(T_base_camera->translation().z(), 0.283, 1e-12);
  EXPECT_TRUE(recording.transform("base_link", "imu_link"));
  EXPECT_GE(recording.imu().size(), 50u);
  EXPECT_EQ(recording.groundTruth("ground_truth/odom", true).body_frame, "base_link");
  recording.forEachPair([](const ros_io::RawPair& pair) {
    EXPECT_NEAR(pair.right_time_s - pair.left_time_s, 0.004, 0.006);
    EXPECT_NE(pair.right_time_s, pair.left_time_s);
    EXPECT_DOUBLE_EQ(pair.rolling_shutter_s, 0.02);
  });
}

TEST(SimulatedBag, ItsCalibrationIsJudgedAsThatOfARecording) {
  sim::StereoCalibrationPair rig = sim::thesisRig();
  rig.right.P(0, 3) *= 1000.0;  // a baseline in mm
  const sim::Simulation simulation(shortScenario(), rig, 1);
  try {
    writeSimulatedBag(testing::TempDir() + "mm.bag", simulation, {0.1, 1, true, false},
                      [](std::size_t, std::size_t) {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected are 0.02 to 2 m"), std::string::npos) << error.what();
  }
}

TEST(SimulatedBag, SaysWhatItCannotWrite) {
  const sim::Simulation simulation(shortScenario(), sim::thesisRig(), 1);
  EXPECT_THROW(writeSimulatedBag("/dev/null/x.bag", simulation, {0.1, 1, true, false},
                                 [](std::size_t, std::size_t) {}),
               InputError);
}

}  // namespace
}  // namespace stereo_nav::tools
