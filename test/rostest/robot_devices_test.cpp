// robot.launch with a rig whose devices are not there. Started by robot_devices.test.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>

#include "nodes/visual_odometry/visual_odometry_params.h"
#include "ros/capture_setup.h"
#include "ros/imu_bridge_params.h"
#include "rostest/diagnostics_probe.h"
#include "rostest/reconfigure.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

TEST(RobotDevices, EachMissingDeviceIsNamed) {
  const DiagnosticsProbe diagnostics;
  const auto says = [&](const std::string& name, const std::string& text) {
    return spinUntil([&] { return diagnostics.says(name, text); });
  };
  EXPECT_TRUE(says("stereo_capture: Left camera", "no-left-camera")) << diagnostics.names();
  EXPECT_TRUE(says("stereo_capture: Right camera", "no-right-camera"));
  for (const char* camera : {"stereo_capture: Left camera", "stereo_capture: Right camera"}) {
    EXPECT_TRUE(says(camera, "is the example that comes with the package")) << diagnostics.textOf(camera);
  }
  EXPECT_TRUE(says("imu_bridge: imu", "no-imu")) << diagnostics.textOf("imu_bridge: imu");
  EXPECT_TRUE(says("visual_odometry: odometry", "/camera/left/image_rect"));
  EXPECT_EQ(diagnostics.levelOf("rig_transforms: mounting"), 0);
}

/// A node that has nothing to do is told from one that has ended.
TEST(RobotDevices, WhatTheRigFileLacksRestsAndSaysSo) {
  const DiagnosticsProbe diagnostics;
  for (const std::string name :
       {"base_bridge", "cmd_vel_mux", "laser_bridge", "range_bridge", "wheel_odometry"})
    EXPECT_TRUE(spinUntil([&] { return diagnostics.says(name + ": rests", "the rig file has no section"); }))
        << name << "\n"
        << diagnostics.names();
}

/// The rig file overrides config/; a parameter that neither of them sets has its default.
TEST(RobotDevices, TheRigFileGoesBeforeTheConfiguration) {
  const auto become = [&](const std::string& name, double expected) {
    double value = 0.0;
    return spinUntil([&] { return ros::param::get(name, value) && value == expected; });
  };
  EXPECT_TRUE(become("/stereo_capture/width", 320)) << "rig";
  EXPECT_TRUE(become("/stereo_capture/rate_hz", 15.0)) << "rig";
  EXPECT_TRUE(become("/stereo_capture/max_time_offset_s", 0.0167)) << "config/capture.yaml";
  EXPECT_TRUE(become("/stereo_capture/buffers", 4)) << "default";
  EXPECT_TRUE(become("/imu_bridge/yaw_stddev_rad", 0.07)) << "rig, not the default of dynamic_reconfigure";
  EXPECT_TRUE(become("/stereo_capture_disparity/disparity_range", 96)) << "rig";
  EXPECT_TRUE(become("/stereo_capture_disparity/correlation_window_size", 15)) << "config/disparity.yaml";
}

TEST(RobotDevices, TheCameraLooksWhereTheRigFileSays) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const Eigen::Isometry3d T = tf2::transformToEigen(
      buffer.lookupTransform("base_link", "camera_left_optical", ros::Time(0), ros::Duration(kLongWait_s)));
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.1, 0.0, 0.3), 1e-9)) << T.translation();
  // Down by 15 degrees, then to the left by 90: the optical axis z points along y, and down.
  const double pitch = 15.0 * M_PI / 180.0;
  EXPECT_TRUE(T.linear().col(2).isApprox(Eigen::Vector3d(0.0, std::cos(pitch), -std::sin(pitch)), 1e-9))
      << T.matrix();
  // The image's x axis, to the right, points forward then.
  EXPECT_TRUE(T.linear().col(0).isApprox(Eigen::Vector3d::UnitX(), 1e-9)) << T.matrix();
}

/// Every live parameter of every node, as its struct describes it; each is put back.
TEST(RobotDevices, LiveParametersCanBeSetOnTheRunningNodes) {
  const std::map<std::string, std::vector<LiveParameter>> nodes = {
      {"/stereo_capture", LiveParameterList::of(ros_io::StereoCaptureParams())},
      {"/imu_bridge", LiveParameterList::of(ros_io::ImuBridgeParams())},
      {"/visual_odometry", LiveParameterList::of(nodes::VisualOdometryParams())}};
  for (const auto& [node, parameters] : nodes) {
    for (const auto& parameter : parameters) {
      const std::string place = node + parameter.section;
      SCOPED_TRACE(place + "/" + parameter.name);
      const auto before = reconfigure(place, {});
      ASSERT_TRUE(before);
      const auto changed = reconfigure(place, {{parameter.name, parameter.max}});
      ASSERT_TRUE(changed);
      EXPECT_EQ(changed->at(parameter.name), parameter.max);
      EXPECT_EQ(reconfigure(place, *before), before);
    }
  }
}

}  // namespace
}  // namespace stereo_nav::test
