// OptiOdom's layout: wheels and motion capture.
#include <nav_msgs/Odometry.h>

#include "import_test_support.h"
#include "kinematics/drive_file.h"
#include "stereo_nav/WheelTicks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"
#include "support/command.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

constexpr const char* kOptiodomMetadata =
    "type,omni3,,,\nngear,12,,,\nencRes,1024,,,\nLi,0.195,,,\nDi,0.102,0.104,0.106,\nThi,,,,\nN,4,,,\nL,,,,\n";

void writeOptiodom(const TemporaryFolder& folder, const std::string& metadata = kOptiodomMetadata) {
  folder.write("2212_metadata.csv", metadata);
  folder.write("2212_run-01.csv", "0,1,2,0.5,-4,-0,1\r\n0.04,1.5,2,0.6,10,20,-30\n0.08,1.5,2,-7,1,2,3\n");
}

TEST(Optiodom, becomesABagAndARig) {
  const TemporaryFolder folder;
  writeOptiodom(folder);
  const auto result =
      test::runCommand(std::string(IMPORT_SEQUENCE) + " --format optiodom " + (folder / "2212_run-01.csv") +
                       " --output " + (folder / "a.bag") + " --rig " + (folder / "rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("a.bag: 3 readings of 3 wheels"), std::string::npos) << result.output;
  const auto ticks = readTopic<WheelTicks>(folder / "a.bag", ros_io::topics::kWheelTicks);
  ASSERT_EQ(ticks.size(), 3u);
  EXPECT_EQ(ticks[1].header.stamp, ros::Time(1000, 40000000));
  EXPECT_EQ(ticks[2].pulses, (std::vector<std::int64_t>{7, 22, -26}));
  EXPECT_EQ(ticks[0].names, (std::vector<std::string>{"front_right", "front_left", "rear"}));
  const auto truth = readTopic<nav_msgs::Odometry>(folder / "a.bag", ros_io::topics::kGroundTruth);
  ASSERT_EQ(truth.size(), 3u);
  EXPECT_EQ(truth[1].pose.pose.position.x, 1.5);
  EXPECT_NEAR(truth[1].pose.pose.orientation.z, std::sin(0.3), 1e-12);
  const kinematics::DriveParams drive = kinematics::readDrive(RigFile::load(folder / "rig.yaml"));
  ASSERT_EQ(drive.wheels.size(), 3u);
  EXPECT_EQ(drive.wheels[1].radius_m, 0.052);
  EXPECT_EQ(drive.wheels[1].pulses_per_turn, 12288.0);
  EXPECT_NEAR(drive.wheels[2].x_m, -0.195, 1e-9);
  EXPECT_EQ(drive.wheels[2].direction_deg, 90.0);
}

TEST(Optiodom, aDifferentialDriveHasItsRightWheelFirst) {
  const TemporaryFolder folder;
  folder.write("1_metadata.csv", "type,diff,\nngear,43.7,\nencRes,64,\nLi,0.2,\nDi,0.084,0.086\n");
  folder.write("1_run-01.csv", "0,0,0,0,0,0\n0.1,0,0,0.1,20,10\n");
  const WheelSequence sequence = readOptiodom(folder / "1_run-01.csv");
  ASSERT_EQ(sequence.drive.wheels.size(), 2u);
  EXPECT_EQ(sequence.drive.wheels[0].name, "right");
  EXPECT_EQ(sequence.drive.wheels[0].y_m, -0.1);
  EXPECT_EQ(sequence.drive.wheels[1].radius_m, 0.043);
  EXPECT_NEAR(sequence.drive.wheels[0].pulses_per_turn, 2796.8, 1e-9);
  EXPECT_EQ(sequence.readings[1].pulses, (std::vector<std::int64_t>{20, 10}));
}

TEST(Optiodom, whatCannotBeUsedIsNamed) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& run) {
    try {
      readOptiodom(folder / run);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  writeOptiodom(folder, "type,tricycle\n");
  EXPECT_NE(refusal("2212_run-01.csv").find("the drive 'tricycle' is not known"), std::string::npos);
  writeOptiodom(folder, "type,omni3\nngear,12\n");
  EXPECT_NE(refusal("2212_run-01.csv").find("has no value of 'Li'"), std::string::npos);
  EXPECT_NE(refusal("other.csv").find("is no run of OptiOdom"), std::string::npos);
  EXPECT_NE(refusal("2213_run-01.csv").find("2213_metadata.csv: cannot be read"), std::string::npos);
  writeOptiodom(folder);
  folder.write("2212_run-02.csv", "0,1,2,0.5,-4,0,1\n0,1,2,0.5,-4,0,1\n");
  EXPECT_NE(refusal("2212_run-02.csv").find("2212_run-02.csv:2: the time does not increase"),
            std::string::npos);
  folder.write("2212_run-03.csv", "0,1,2,0.5,-4\n");
  EXPECT_NE(refusal("2212_run-03.csv").find("at least 6 are needed"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
