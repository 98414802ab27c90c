// CARMEN logs whose poses were corrected: scans, wheels and reference.
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include <cmath>

#include "import_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"
#include "support/command.h"
#include "tools/import_sequence/laser_sequence.h"

namespace stereo_nav::tools {
namespace {

/// The wheels count 1 m forward, then a turn of 90 degrees, then 1 m; the correction moves the robot by 0.1
/// m to the left after the first metre, and its ODOM line with stamp 0 carries on from there.
constexpr const char* kCarmenLog =
    "# message formats defined: PARAM ODOM FLASER\n"
    "PARAM robot_frontlaser_offset 0.0 host 0\n"
    "ODOM 0 0 0 0 0 0 0.1 host 0.1\n"
    "FLASER 3 1.5 81.83 2.5 0 0 0 0 0 0 0.1 host 0.1\n"
    "ODOM 0 0 0 0 0 0 0 host 0\n"
    "ODOM 1 0 0 0 0 0 0.5 host 0.5\n"
    "FLASER 3 0.5 1 1.5 1 0.1 0 1 0.1 0 0.5 host 0.5\n"
    "ODOM 1 0.1 0 0 0 0 0 host 0\n"
    "NEFF 10\n"
    "ODOM 1 0.1 1.5707963267948966 0 0 0 0.9 host 0.9\n"
    "ODOM 1 1.1 1.5707963267948966 0 0 0 1.3 host 1.3\n"
    "ODOM 1 1.1 1.5707963267948966 0 0 0 1.2 host 1.2\n";

TEST(Carmen, wheelsAreTheIncrementsAndNotTheCorrections) {
  const TemporaryFolder folder;
  folder.write("a.log", kCarmenLog);
  const LaserSequence sequence = readCarmen(folder / "a.log");
  ASSERT_EQ(sequence.wheels.size(), 4u);
  EXPECT_EQ(sequence.repeated, 0u);
  EXPECT_NEAR(sequence.wheels[1].T_world_body.translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(sequence.wheels[1].T_world_body.translation().y(), 0.0, 1e-12);
  EXPECT_NEAR(sequence.wheels[3].T_world_body.translation().y(), 1.0, 1e-12);
  EXPECT_NEAR(pathLength(sequence.wheels), 2.0, 1e-12);
  ASSERT_EQ(sequence.reference.size(), 2u);
  EXPECT_NEAR(sequence.reference[1].T_world_body.translation().y(), 0.1, 1e-12);
}

TEST(Carmen, becomesABag) {
  const TemporaryFolder folder;
  folder.write("a.log", kCarmenLog);
  const auto result = test::runCommand(std::string(IMPORT_SEQUENCE) + " --format carmen " +
                                       (folder / "a.log") + " --output " + (folder / "a.bag"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("a.bag: 2 scans, 4 wheel poses, 2.0 m by the wheels"), std::string::npos)
      << result.output;
  const auto scans = readTopic<sensor_msgs::LaserScan>(folder / "a.bag", ros_io::topics::kScan);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].header.stamp, ros::Time(1000, 100000000));
  EXPECT_NEAR(scans[0].angle_min, -M_PI / 2, 1e-6);
  EXPECT_NEAR(scans[0].angle_increment, M_PI / 3, 1e-6);
  EXPECT_EQ(scans[0].ranges[0], 1.5f);
  EXPECT_TRUE(std::isinf(scans[0].ranges[1]));
  const auto truth = readTopic<nav_msgs::Odometry>(folder / "a.bag", ros_io::topics::kGroundTruth);
  ASSERT_EQ(truth.size(), 2u);
  EXPECT_EQ(truth[0].header.frame_id, ros_io::frames::kCorrectedMap);
}

TEST(Carmen, whatCannotBeUsedIsNamed) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& log) {
    folder.write("b.log", log);
    try {
      readCarmen(folder / "b.log");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_NE(refusal("nothing here\n").find("holds 0 FLASER and 0 ODOM lines"), std::string::npos);
  EXPECT_NE(refusal("FLASER 1e9\n").find("is not a whole number"), std::string::npos);
  EXPECT_NE(refusal("FLASER 99999 1 2\n").find("a FLASER line of 99999 beams"), std::string::npos);
  EXPECT_NE(refusal("FLASER 2 1\n").find("is it of another format?"), std::string::npos);
  EXPECT_NE(refusal("FLASER 2 1 2 0 0 0 0 0 0 1 h 1\nFLASER 3 1 2 3 0 0 0 0 0 0 2 h 2\n").find("changes"),
            std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
