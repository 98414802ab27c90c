#include "ros/robot_description.h"

#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>

#include <filesystem>
#include <map>
#include <set>

#include "kinematics/drive_file.h"
#include "kinematics/layouts.h"
#include "ros/laser_bridge_params.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::ros_io {
namespace {

RobotGeometry swerveWithServo() {
  RobotGeometry robot;
  robot.camera_frame = "camera_left_optical";
  robot.imu_frame = "imu_link";
  robot.mounting.camera.x_m = 0.3;
  robot.mounting.camera.z_m = 0.3;
  robot.drive = kinematics::swerveDrive({{0.2, 0.2}, {-0.2, -0.2}}, 0.05);
  robot.joints.resize(1);
  robot.joints[0].name = "tilt";
  robot.joints[0].mounting.x_m = 0.25;
  robot.joints[0].mounting.z_m = 0.28;
  robot.ranges.resize(1);
  robot.ranges[0].name = "front";
  robot.ranges[0].mounting.x_m = 0.4;
  robot.laser_frame = "laser_link";
  robot.mounting.laser.z_m = 0.2;
  robot.mounting.laser.yaw_deg = 180.0;
  robot.range_finders.resize(1);
  robot.range_finders[0].name = "left";
  robot.range_finders[0].mounting.y_m = 0.3;
  robot.range_finders[0].mounting.yaw_deg = 90.0;
  return robot;
}

/// The values of an attribute at all places of `before`, e.g. `<child link="`.
std::multiset<std::string> valuesBehind(const std::string& text, const std::string& before) {
  std::multiset<std::string> values;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const std::size_t begin = at + before.size();
    values.insert(text.substr(begin, text.find('"', begin) - begin));
  }
  return values;
}

TEST(RobotDescription, MovingThingsAreInTheUrdfAndFixedOnesAreNot) {
  const RobotGeometry robot = swerveWithServo();
  const std::string urdf = robotDescription(robot);
  std::multiset<std::string> children = valuesBehind(urdf, "<child link=\"");
  EXPECT_EQ(children, (std::multiset<std::string>{"module_1_steering", "module_1_wheel", "module_2_steering",
                                                  "module_2_wheel", "tilt_link"}));
  EXPECT_EQ(valuesBehind(urdf, "<link name=\"").size(), children.size() + 1);
  EXPECT_EQ(urdf.find("\"fixed\""), std::string::npos);
  for (const auto& transform : fixedTransforms(robot)) children.insert(transform.child_frame_id);
  const std::set<std::string> frames(children.begin(), children.end());
  EXPECT_EQ(children.size(), frames.size()) << "each frame has one publisher";
  for (const std::string frame :
       {"camera_left_optical", "imu_link", "range_front", "laser_link", "range_left"})
    EXPECT_EQ(frames.count(frame), 1U) << frame;
}

TEST(RobotDescription, SensorsAreWhereTheRigFileSays) {
  const RobotGeometry robot = swerveWithServo();
  std::map<std::string, Eigen::Isometry3d> found;
  for (const auto& transform : fixedTransforms(robot)) {
    EXPECT_EQ(transform.header.frame_id, "base_link");
    found[transform.child_frame_id] = Eigen::Isometry3d(tf2::transformToEigen(transform));
  }
  EXPECT_TRUE(found["laser_link"].isApprox(robot.mounting.laser.T_base_sensor(), 1e-9));
  // A range finder looks along its x axis: this one to the left.
  const Eigen::Vector3d seen = found["range_left"] * Eigen::Vector3d(2.0, 0.0, 0.0);
  EXPECT_TRUE(seen.isApprox(Eigen::Vector3d(0.0, 2.3, 0.0), 1e-9)) << seen.transpose();
  RobotGeometry without_laser = robot;
  without_laser.laser_frame.clear();
  EXPECT_EQ(fixedTransforms(without_laser).size(), found.size() - 1);
}

/// What is drawn beside the wheels: body, IMU, laser scanner, two range finders, servo, camera.
TEST(RobotDescription, SensorsAreDrawnOnTheLinkThatCarriesThem) {
  RobotGeometry robot = swerveWithServo();
  const auto drawnOn = [&](const std::string& link) {
    const std::string urdf = robotDescription(robot);
    const std::size_t begin = urdf.find("<link name=\"" + link + "\">");
    const std::string element = urdf.substr(begin, urdf.find("</link>", begin) - begin);
    return valuesBehind(element, "<material name=\"").size();
  };
  EXPECT_EQ(drawnOn("base_link"), 6U);
  EXPECT_EQ(drawnOn("tilt_link"), 1U);
  robot.joints[0].carries_camera = true;
  EXPECT_EQ(drawnOn("base_link"), 5U);
  EXPECT_EQ(drawnOn("tilt_link"), 2U);
}

TEST(RobotDescription, TwoSensorsInOneFrameAreRefusedByName) {
  RobotGeometry robot = swerveWithServo();
  robot.range_finders[0].name = "front";
  try {
    fixedTransforms(robot);
    FAIL() << "range_front is there twice";
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("two parts have the frame 'range_front'"), std::string::npos)
        << error.what();
  }
}

/// robot_state_publisher would publish it, and so would rig_transforms.
TEST(RobotDescription, AServoWhoseLinkIsASensorsFrameIsRefused) {
  RobotGeometry robot = swerveWithServo();
  robot.joints[0].name = "laser";
  try {
    fixedTransforms(robot);
    FAIL() << "laser_link is there twice";
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("two parts have the frame 'laser_link'"), std::string::npos)
        << error.what();
  }
}

TEST(RobotDescription, ACameraOnAServoIsWhereTheMountingSaysAtAnAngleOfZero) {
  RobotGeometry robot = swerveWithServo();
  EXPECT_EQ(fixedTransforms(robot)[0].header.frame_id, "base_link");
  robot.joints[0].carries_camera = true;
  robot.joints[0].mounting.yaw_deg = 90.0;
  const auto camera = fixedTransforms(robot)[0];
  EXPECT_EQ(camera.header.frame_id, "tilt_link");
  const Eigen::Isometry3d T_base_camera =
      robot.joints[0].mounting.T_base_sensor() * Eigen::Isometry3d(tf2::transformToEigen(camera));
  EXPECT_TRUE(T_base_camera.isApprox(robot.mounting.camera.T_base_optical(), 1e-9));
  robot.joints.push_back(robot.joints[0]);
  EXPECT_THROW(fixedTransforms(robot), ParameterError);
}

/// Every rig file that the package brings can be used as it is.
TEST(RigFiles, AreReadByAllWhoReadThem) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(STEREO_NAV_SOURCE_DIR "/config/rigs")) {
    const RigFile rig = RigFile::load(entry.path().string());
    found.insert(entry.path().stem().string());
    RobotGeometry robot;
    robot.camera_frame = "camera_left_optical";
    robot.imu_frame = "imu_link";
    robot.mounting = rig.mounting();
    if (entry.path().stem() == "thesis") continue;  // no wheels
    robot.drive = kinematics::readDrive(rig);
    BaseBridgeParams base;
    readParameters(rig.section(rig_sections::kBase), rig.sectionName(rig_sections::kBase), base);
    EXPECT_NO_THROW(base.checkNames());
    LaserBridgeParams laser;
    readParameters(rig.section(rig_sections::kLaser), rig.sectionName(rig_sections::kLaser), laser);
    RangeBridgeParams ranges;
    readParameters(rig.section(rig_sections::kRangeFinders), rig.sectionName(rig_sections::kRangeFinders),
                   ranges);
    if (!rig.section(rig_sections::kRangeFinders).IsNull()) {
      EXPECT_NO_THROW(ranges.check());
    }
    robot.ranges = base.ranges;
    robot.joints = base.joints;
    robot.range_finders = ranges.finders;
    EXPECT_NO_THROW(fixedTransforms(robot)) << entry.path();
    EXPECT_NO_THROW(kinematics::WheelCommander(robot.drive, base.limits)) << entry.path();
  }
  EXPECT_EQ(found, (std::set<std::string>{"ackermann", "differential", "mecanum", "omni3", "simulated",
                                          "swerve", "thesis"}));
}

}  // namespace
}  // namespace stereo_nav::ros_io
