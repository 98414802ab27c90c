#include "tools/simulate/driven_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include <fstream>
#include <iterator>
#include <map>

#include "sim_test_support.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

std::string writtenCommands(const std::string& text) {
  const std::string path = testing::TempDir() + "commands.txt";
  std::ofstream(path) << text;
  return path;
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeDriven(const std::string& path, int threads) {
  sim::Scenario scenario = sim::loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml",
                                             {"rig.samples_per_pixel=1", "timing.rate_hz=5"});
  scenario.driven.longest_s = 2.0;
  const RigFile rig = RigFile::load(STEREO_NAV_SOURCE_DIR "/config/rigs/simulated.yaml");
  const ros_io::DrivenDevices devices = ros_io::readDrivenDevices(rig);
  sim::DrivenSimulation simulation(scenario, devices.rig, sim::thesisRig(), 3);
  const auto commands = readVelocities(writtenCommands("# a short way\n0.1 0.3 0 0.2\n\n0.9 0 0 0\n"));
  writeDrivenBag(path, simulation, devices, rig.mounting().imu.T_base_sensor(), commands,
                 {std::numeric_limits<double>::infinity(), threads, true, false});
}

TEST(DrivenBag, HoldsWhatTheBridgesPublishAndTheSameBytesEachTime) {
  const std::string folder = testing::TempDir();
  writeDriven(folder + "driven.bag", 1);
  writeDriven(folder + "driven_again.bag", 2);
  EXPECT_TRUE(contentOf(folder + "driven.bag") == contentOf(folder + "driven_again.bag"));
  rosbag::Bag bag(folder + "driven.bag");
  std::map<std::string, int> counts;
  for (const auto& message : rosbag::View(bag)) ++counts[message.getTopic()];
  EXPECT_NEAR(counts["wheel_ticks"], 46, 1);
  EXPECT_EQ(counts["joint_states"], counts["wheel_ticks"]);
  EXPECT_EQ(counts["ground_truth/odom"], counts["wheel_ticks"]);
  EXPECT_EQ(counts["scan"], 9);
  EXPECT_NEAR(counts["range/front"], 19, 1);
  EXPECT_NEAR(counts["imu/data"], 90, 1);
  EXPECT_EQ(counts["camera/left/image_raw"], 5);
  EXPECT_EQ(counts["camera/right/camera_info"], 5);
}

TEST(DrivenBag, SaysWhichLineIsNoCommand) {
  for (const auto& [text, part] :
       {std::pair("0 0.3 0\n", "line 1"), std::pair("0 1 0 0\n1 x 0 0\n", "line 2"),
        std::pair("2 1 0 0\n1 1 0 0\n", "sort the lines"), std::pair("# nothing\n", "no commands")}) {
    try {
      readVelocities(writtenCommands(text));
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace stereo_nav::tools
