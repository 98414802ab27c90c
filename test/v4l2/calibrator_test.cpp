// Runs inside the virtual machine of vm.sh, beside a ROS master: the calibration of docs/capture.md, with the
// window of camera_calibration on a virtual screen.
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>

#include <chrono>
#include <filesystem>
#include <iostream>

#include "support/foreign_program.h"
#include "support/node_process.h"
#include "support/virtual_screen.h"
#include "v4l2/checkerboard.h"
#include "v4l2/feeder.h"
#include "v4l2/ros_probe.h"

namespace stereo_nav::test {
namespace {

using namespace std::chrono_literals;

TEST(Calibrator, CommitSavesTheGeometryOfTheCameras) {
  if (!VirtualScreen::available()) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  const std::string calibrator = "/usr/lib/camera_calibration/cameracalibrator.py";
  if (!std::filesystem::exists(calibrator)) GTEST_SKIP() << calibrator << " is not installed";
  const CheckerboardRig rig;
  constexpr auto kPeriod = 1000ms;
  camera::Feeder left_feeder("/dev/video10", V4L2_PIX_FMT_MJPEG, rig.width, rig.height);
  camera::Feeder right_feeder("/dev/video11", V4L2_PIX_FMT_MJPEG, rig.width, rig.height);
  const auto first = std::chrono::steady_clock::now() + 100ms;
  const auto viewFrom = [&rig](double camera_x_m) {
    return
        [&rig, camera_x_m](std::uint32_t counter) { return camera::jpegOf(rig.draw(counter, camera_x_m)); };
  };
  left_feeder.start(first, kPeriod, viewFrom(0.0));
  right_feeder.start(first + 10ms, kPeriod, viewFrom(rig.baseline_m));

  setCameras("/dev/video10", "/dev/video11", rig.width, rig.height, 1.0);
  ros::param::set(kNode + "/stamps", "true");  // each image its own: free-running cameras
  ros::param::set(kNode + "/load_image_proc", false);
  Topic<sensor_msgs::CameraInfo> left("camera/left/camera_info"), right("camera/right/camera_info");
  const VirtualScreen screen("/tmp");
  const NodeProcess capture_node({STEREO_CAPTURE});
  // cameracalibrator.py waits for the services for five seconds only.
  ASSERT_TRUE(comesTrue([&] { return !left.messages.empty() && !right.messages.empty(); }));
  EXPECT_EQ(right.messages.back()->K[0], 0.0) << "not calibrated yet";
  ForeignProgram calibration("cameracalibrator",
                             "export LIBGL_ALWAYS_SOFTWARE=1; exec " PRESS_BUTTONS
                             " --size 8x6 --square 0.051 --approximate 0.02"
                             " right:=/camera/right/image_raw left:=/camera/left/image_raw"
                             " right_camera:=/camera/right left_camera:=/camera/left");
  // The right camera's calibration is committed last.
  const auto is_committed = [&] {
    ros::spinOnce();
    return right.messages.back()->K[0] != 0.0;
  };
  // The calibrator ends once it has committed, perhaps before the camera_info is here.
  ASSERT_TRUE(calibration.comesUp(is_committed, 400.0) || comesTrue(is_committed))
      << calibration.command().output();
  std::cout << calibration.command().output();

  const std::string folder = "/tmp/ros_home/camera_info/";
  EXPECT_TRUE(std::filesystem::exists(folder + "left.yaml"));
  EXPECT_TRUE(std::filesystem::exists(folder + "right.yaml"));
  const auto left_images = left.messages.size();
  ASSERT_TRUE(comesTrue([&] { return left.messages.size() > left_images; }));
  const double baseline_m = -right.messages.back()->P[3] / right.messages.back()->P[0];
  std::cout << "calibrated: focal lengths " << left.messages.back()->K[0] << " and "
            << right.messages.back()->K[0] << " px, baseline " << baseline_m << " m\n";
  for (const auto& info : {left.messages.back(), right.messages.back()}) {
    EXPECT_EQ(static_cast<int>(info->width), rig.width);
    EXPECT_NEAR(info->K[0], rig.focal_length_px, 0.03 * rig.focal_length_px);
    EXPECT_NEAR(info->K[4], rig.focal_length_px, 0.03 * rig.focal_length_px);
  }
  EXPECT_NEAR(baseline_m, rig.baseline_m, 0.03 * rig.baseline_m);
}

}  // namespace
}  // namespace stereo_nav::test
