#include "ros/capture_setup.h"

#include <gtest/gtest.h>

#include "core/rig_file.h"

namespace stereo_nav {
namespace {

TEST(CaptureSetup, TheRigFileInThePackageIsValid) {
  const RigFile rig = RigFile::load(std::string(STEREO_NAV_SOURCE_DIR) + "/config/rigs/thesis.yaml");
  ros_io::CaptureSetup setup;
  setup.read({{rig.section(rig_sections::kCameras), rig.sectionName(rig_sections::kCameras)}});
  EXPECT_EQ(setup.params.capture.width, 320);
  EXPECT_FALSE(setup.toConfig().right.device.empty());
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
