// Operation: nodes start in any order, end cleanly on Ctrl-C, notice that the master has gone and come back
// with it, and refuse parameters by name. Everything runs on masters of the test's own, with simulated
// devices.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/background_command.h"
#include "support/command.h"
#include "support/foreign_program.h"
#include "support/own_master.h"
#include "support/wait.h"

namespace stereo_nav::test {
namespace {

const std::string kRos = "PATH=/usr/bin:$PATH ";
// By its path: under rostest the package is found both in its source folder and in the devel space.
const std::string kRobot =
    kRos + "exec roslaunch " LAUNCH_FOLDER
           "/robot.launch simulated:=true 'settings:=rig.samples_per_pixel=1;timing.rate_hz=8' ";

/// Waits for one message.
bool comes(const std::string& topic, double seconds = kLongWait_s) {
  const std::string limit = std::to_string(static_cast<int>(seconds));
  return runCommand(kRos + "timeout " + limit + " rostopic echo -n1 " + topic).status == 0;
}

TEST(Operation, CtrlCEndsEveryNodeByItself) {
  OwnMaster master;
  master.start();
  BackgroundCommand robot(kRobot);
  ASSERT_TRUE(comes("/odom")) << robot.output();
  const auto begin = std::chrono::steady_clock::now();
  robot.signal(SIGINT);
  ASSERT_EQ(robot.waitFor(kLongWait_s), 0) << robot.output();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  RecordProperty("seconds", std::to_string(took.count()));
  std::cout << "ended in " << took.count() << " s\n";
  // roslaunch kills nodes that do not end, and says so.
  EXPECT_EQ(robot.count("escalating to"), 0) << robot.output();
  EXPECT_EQ(robot.count("has died"), 0) << robot.output();
}

TEST(Operation, AGoneMasterEndsTheNodesAndTheNextOneFindsThemAgain) {
  OwnMaster master;
  master.start();
  BackgroundCommand robot(kRobot + "nodelet:=false");
  ASSERT_TRUE(comes("/odom")) << robot.output();
  master.crash();
  // Each of the package's four processes says so and ends with a status that is not 0; roslaunch starts it
  // again.
  EXPECT_TRUE(robot.waitForOutput("has died [pid", kLongWait_s, 4)) << robot.output();
  EXPECT_EQ(robot.count("has gone: its port refuses connections"), 4) << robot.output();
  EXPECT_EQ(robot.count("exit code 3"), 4) << robot.output();
  master.start();
  EXPECT_TRUE(comes("/odom")) << robot.output();
  robot.signal(SIGINT);
  EXPECT_EQ(robot.waitFor(kLongWait_s), 0) << robot.output();
}

TEST(Operation, AMasterThatIsReplacedAtOnceIsNoticedToo) {
  OwnMaster master;
  master.start();
  BackgroundCommand robot(kRobot);
  ASSERT_TRUE(comes("/odom")) << robot.output();
  master.crash();
  master.start();
  EXPECT_TRUE(robot.waitForOutput("has gone: ")) << robot.output();
  EXPECT_TRUE(comes("/odom")) << robot.output();
  robot.signal(SIGINT);
  EXPECT_EQ(robot.waitFor(kLongWait_s), 0) << robot.output();
}

TEST(Operation, NodesStartInAnyOrder) {
  OwnMaster master;
  // The odometry before the master, the manager that it is to be loaded into, the cameras and the transforms.
  BackgroundCommand odometry(
      kRos + "exec rosrun nodelet nodelet load stereo_nav/visual_odometry simulator __name:=visual_odometry");
  ASSERT_TRUE(odometry.waitForOutput("Failed to contact master")) << odometry.output();
  master.start();
  BackgroundCommand robot(kRobot + "odometry:=false");
  EXPECT_TRUE(comes("/odom")) << odometry.output() << robot.output();
  odometry.signal(SIGINT);
  robot.signal(SIGINT);
  EXPECT_EQ(robot.waitFor(kLongWait_s), 0) << robot.output();
}

class Rviz : public testing::TestWithParam<const char*> {};

TEST_P(Rviz, ShowsAllOfTheOdometryAndTheSensorsOfTheBase) {
  // roslaunch starts the master: were rviz to be started again, the next one knows no subscribers of the
  // first.
  const OwnMaster master;
  // Xvfb finds a free display itself and prints its number.
  const BackgroundCommand screen("exec Xvfb -displayfd 1 -screen 0 1000x700x24");
  ASSERT_TRUE(screen.waitForOutput("\n")) << "Xvfb does not start";
  ForeignProgram rviz("rviz", "export DISPLAY=:" + std::to_string(std::atoi(screen.output().c_str())) +
                                  " LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1; " + kRos +
                                  "exec roslaunch " LAUNCH_FOLDER "/visualise.launch view:=" + GetParam());
  std::vector<std::string> topics = {
      "/path", "/odom",     "/vo/features", "/vo/debug_image", "/vo/disparity_view", "/ground_truth/odom",
      "/tf",   "/tf_static"};
  if (std::string(GetParam()) == "robot")
    topics.insert(topics.end(), {"/scan", "/range/front", "/range/rear", "/range/left", "/range/right"});
  for (const std::string& topic : topics) {
    const auto isSubscribed = [&topic] {
      return runCommand(kRos + "rostopic info " + topic).output.find("* /rviz") != std::string::npos;
    };
    EXPECT_TRUE(rviz.comesUp(isSubscribed, kLongWait_s)) << topic << "\n" << rviz.command().output();
  }
  rviz.command().signal(SIGINT);
  EXPECT_EQ(rviz.command().waitFor(kLongWait_s), 0) << rviz.command().output();
}

INSTANTIATE_TEST_SUITE_P(BothViews, Rviz, testing::Values("robot", "offline"));

/// Output of rig_transforms for a rig file, and its exit status.
CommandResult checkRig(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "stereo_nav_operation_test_rig.yaml";
  std::ofstream(path) << text;
  return runCommand(kRos + "timeout 60 " RIG_TRANSFORMS " _rig:=" + path.string());
}

TEST(Operation, AMistakeInTheRigFileIsNamed) {
  OwnMaster master;
  master.start();
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"camera: {}", "unknown section camera; a rig has: cameras | imu | laser"},
      {"cameras: {widht: 320}", "cameras: unknown parameter widht"},
      {"cameras: {width: 3}", "cameras: width is 3, allowed is 16 to 8192 px"},
      {"cameras: {left: {divice: /dev/video0}}", "cameras: unknown parameter left.divice"},
      {"cameras: {left: {controls: {gain: high}}}", "left.controls.gain must be a whole number"},
      {"imu: {protocol: magic}", "imu: protocol is 'magic', allowed is one of: angles | raw"},
      {"mounting: {camera: {z_m: 283}}", "mounting: camera.z_m is 283, allowed is -100 to 100 m"},
      {"mounting: {camera: {z_m: high}}", "mounting: camera.z_m is 'high', must be a number"},
      {"disparity: {disparity_range: 8}", "disparity: disparity_range is 8, allowed is 32 to 4096 px"},
      {"base: {ranges: 1, range_1: {name: front}}\nrange_finders: {finders: 1, finder_1: {name: front}}",
       "two parts have the frame 'range_front'"},
      {"range_finders: {finders: 1, finder_1: {name: a/b}}", "name 'a/b' cannot be part of a topic"},
      {"just a text", "a rig file holds sections"},
  };
  for (const auto& [rig, message] : mistakes) {
    const CommandResult result = checkRig(rig);
    EXPECT_EQ(result.status, 2) << rig;
    EXPECT_NE(result.output.find(message), std::string::npos) << rig << "\n" << result.output;
  }
}

}  // namespace
}  // namespace stereo_nav::test
