#include "ros/rig.h"

#include <gtest/gtest.h>

#include "ros/capture_setup.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav {
namespace {

TEST(Rig, OpticalAxesOfALevelCamera) {
  ros_io::Mounting mounting;
  mounting.camera.z_m = 0.283;
  const Eigen::Isometry3d T = mounting.T_base_optical();
  EXPECT_TRUE((T * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0.283)));   // ahead
  EXPECT_TRUE((T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0.283)));  // to the right
  EXPECT_TRUE((T * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -0.717)));  // down
}

TEST(Rig, AnglesTurnAboutFixedAxesRollFirst) {
  ros_io::SensorMounting pose;
  pose.roll_deg = 90.0;
  pose.yaw_deg = 90.0;
  // y goes up by the roll and stays there; x goes to the left by the yaw.
  EXPECT_TRUE(
      (pose.T_base_sensor().linear() * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(
      (pose.T_base_sensor().linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(Rig, TheOneInThePackageIsValidAndKeepsTheThesisMounting) {
  const std::string path = std::string(STEREO_NAV_SOURCE_DIR) + "/config/rigs/thesis.yaml";
  const ros_io::Mounting mounting = ros_io::loadMounting(path);
  EXPECT_EQ(mounting.camera.z_m, 0.283);
  ros_io::CaptureSetup setup;
  setup.read({{ros_io::loadRigSection(path, ros_io::rig_sections::kCameras), path}});
  EXPECT_EQ(setup.params.capture.width, 320);
  EXPECT_FALSE(setup.toConfig().right.device.empty());
}

TEST(Rig, PathsOfUrls) {
  EXPECT_EQ(ros_io::pathOfUrl("file:///etc/left.yaml"), "/etc/left.yaml");
  EXPECT_EQ(ros_io::pathOfUrl("/etc/left.yaml"), "/etc/left.yaml");
  EXPECT_THROW(ros_io::pathOfUrl("http://example.org/left.yaml"), ParameterError);
  EXPECT_THROW(ros_io::pathOfUrl("package://no_such_package_here/left.yaml"), ParameterError);
}

TEST(CaptureSetup, LaterSourcesGoBeforeEarlierOnes) {
  ros_io::CaptureSetup setup;
  setup.read(
      {{YAML::Load("{width: 640, height: 480, controls: {gain: 1}}"), "config"},
       {YAML::Load("{width: 320, left: {device: a, controls: {gain: 3}}, right: {device: b}}"), "rig"}});
  const camera::StereoConfig config = setup.toConfig();
  EXPECT_EQ(config.left.format.width, 320);
  EXPECT_EQ(config.left.format.height, 480);
  ASSERT_EQ(config.left.controls.size(), 1u) << "the camera's own value takes the place of the one for both";
  EXPECT_EQ(config.left.controls.back().value, 3);
  ASSERT_EQ(config.right.controls.size(), 1u);
  EXPECT_EQ(config.right.controls.back().value, 1);
}

TEST(CaptureSetup, ARollingShutterIsOneOfBothCamerasAndFitsBetweenTwoImages) {
  ros_io::CaptureSetup setup;
  setup.read({{YAML::Load("{left: {device: a}, right: {device: b}, rate_hz: 30.0, rolling_shutter_ms: 25.0}"),
               "rig"}});
  const camera::StereoConfig config = setup.toConfig();
  EXPECT_DOUBLE_EQ(config.left.rolling_shutter_s, 0.025);
  EXPECT_DOUBLE_EQ(config.right.rolling_shutter_s, 0.025);
  setup.params.capture.rolling_shutter_ms = 40.0;
  EXPECT_THROW(setup.toConfig(), ParameterError);
}

TEST(CaptureSetup, OneCameraIsNoStereoCamera) {
  ros_io::CaptureSetup setup;
  EXPECT_THROW(setup.toConfig(), ParameterError);
  setup.params.left.device = setup.params.right.device = "/dev/video0";
  EXPECT_THROW(setup.toConfig(), ParameterError);
}

}  // namespace
}  // namespace stereo_nav
