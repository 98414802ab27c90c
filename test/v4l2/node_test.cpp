// Runs inside the virtual machine of vm.sh, beside a ROS master: the real nodes on its cameras.
#include <cv_bridge/cv_bridge.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <stereo_msgs/DisparityImage.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

#include "sensors/camera/v4l2_device.h"
#include "stereo_nav/StereoSync.h"
#include "support/node_process.h"
#include "v4l2/feeder.h"
#include "v4l2/ros_probe.h"

namespace stereo_nav::test {
namespace {

using namespace std::chrono_literals;

/// The calibration of the thesis' rig, 320 x 240.
sensor_msgs::CameraInfo calibration(bool right) {
  sensor_msgs::CameraInfo info;
  info.width = 320;
  info.height = 240;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {417.0, 0, 153.0, 0, 417.0, 130.0, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {463.8, 0, 141.8, right ? -56.86 : 0.0, 0, 463.8, 117.1, 0, 0, 0, 1, 0};
  return info;
}

std::string diagnosticsText(const Topic<diagnostic_msgs::DiagnosticArray>& topic,
                            const std::string& status_name) {
  std::string text;
  for (const auto& message : topic.messages) {
    for (const auto& status : message->status) {
      if (status.name.find(status_name) == std::string::npos) continue;
      text = status.message;
      for (const auto& value : status.values) text += "\n" + value.key + ": " + value.value;
    }
  }
  return text;
}

TEST(StereoCaptureNode, PublishesMatchingPairsAndSavesTheCalibration) {
  constexpr auto kPeriod = 250ms;
  const auto source = [](std::uint32_t counter) {
    return camera::jpegOf(camera::drawCounter(320, 240, counter));
  };
  camera::Feeder left_feeder("/dev/video10", V4L2_PIX_FMT_MJPEG, 320, 240);
  camera::Feeder right_feeder("/dev/video11", V4L2_PIX_FMT_MJPEG, 320, 240);
  const auto first = std::chrono::steady_clock::now() + 100ms;
  left_feeder.start(first, kPeriod, source);
  right_feeder.start(first + 10ms, kPeriod, source);

  Topic<sensor_msgs::Image> left("camera/left/image_raw"), right("camera/right/image_raw");
  Topic<sensor_msgs::CameraInfo> left_info("camera/left/camera_info"), right_info("camera/right/camera_info");
  Topic<StereoSync> sync("camera/sync");
  Topic<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  setCameras("/dev/video10", "/dev/video11", 320, 240, 4.0);
  auto node = std::make_unique<NodeProcess>(std::vector<std::string>{STEREO_CAPTURE});

  ASSERT_TRUE(comesTrue([&] { return right.messages.size() >= 12 && right_info.messages.size() >= 12; }));
  EXPECT_EQ(right_info.messages.back()->K[0], 0.0) << "not calibrated yet, and images flow all the same";
  EXPECT_TRUE(comesTrue([&] {
    return diagnosticsText(diagnostics, "Left camera")
               .find("no calibration: file:///tmp/ros_home/camera_info/left.yaml") != std::string::npos;
  })) << diagnosticsText(diagnostics, "Left camera");

  std::map<ros::Time, sensor_msgs::ImageConstPtr> lefts;
  for (const auto& image : left.messages) lefts[image->header.stamp] = image;
  std::map<ros::Time, StereoSyncConstPtr> syncs;
  for (const auto& message : sync.messages) syncs[message->header.stamp] = message;
  std::size_t compared = 0;
  const double ros_minus_monotonic_s = rosMinusMonotonic_s();
  for (std::size_t i = 1; i < right.messages.size(); ++i) {
    const auto& image = right.messages[i];
    EXPECT_EQ(image->header.frame_id, "camera_left_optical");
    const auto partner = lefts.find(image->header.stamp);
    const auto pair = syncs.find(image->header.stamp);
    if (partner == lefts.end() || pair == syncs.end()) continue;  // lost on the way here while subscribing
    const auto counter = camera::readCounter(cv_bridge::toCvCopy(partner->second, "mono8")->image);
    EXPECT_EQ(counter, camera::readCounter(cv_bridge::toCvCopy(image, "mono8")->image));
    EXPECT_NEAR(pair->second->skew_s, 0.010, 1e-5);
    EXPECT_NEAR((pair->second->right_stamp - pair->second->left_stamp).toSec(), 0.010, 1e-5);
    // The feeder's time of the image, not the time of its arrival; only the clock's offset is measured.
    const double due_s =
        std::chrono::duration<double>((first + counter * kPeriod).time_since_epoch()).count();
    EXPECT_NEAR(image->header.stamp.toSec(), due_s + ros_minus_monotonic_s, 0.005);
    ++compared;
  }
  EXPECT_GE(compared, 6u);

  // What camera_calibration's COMMIT does.
  for (const std::string side : {"left", "right"}) {
    sensor_msgs::SetCameraInfo request;
    request.request.camera_info = calibration(side == "right");
    ASSERT_TRUE(ros::service::call("camera/" + side + "/set_camera_info", request));
    EXPECT_TRUE(request.response.success) << request.response.status_message;
    EXPECT_TRUE(std::filesystem::exists("/tmp/ros_home/camera_info/" + side + ".yaml"));
  }
  Topic<sensor_msgs::Image> rectified("camera/left/image_rect");
  Topic<stereo_msgs::DisparityImage> disparity("camera/disparity");
  EXPECT_TRUE(comesTrue([&] { return rectified.messages.size() >= 2 && disparity.messages.size() >= 2; }));
  ASSERT_FALSE(disparity.messages.empty());
  EXPECT_NEAR(disparity.messages.back()->T, 56.86 / 463.8, 1e-3);
  EXPECT_EQ(node->stop(), 0);

  left_info.messages.clear();
  node = std::make_unique<NodeProcess>(std::vector<std::string>{STEREO_CAPTURE});
  ASSERT_TRUE(comesTrue([&] { return !left_info.messages.empty(); }));
  EXPECT_EQ(left_info.messages.back()->K[0], 417.0) << "the saved calibration is loaded";
}

std::int32_t controlOf(const std::string& path, const std::string& name) {
  camera::V4l2Device device(camera::linuxKernel(), path);
  return device.controls().get(*device.controls().find(name));
}

TEST(StereoCaptureNode, ReconfiguresAndSurvivesADisconnection) {
  setCameras("platform:vivid-000", "platform:vivid-001", 320, 180, 10.0);
  ros::param::set(kNode + "/encoding", "mono8");
  ros::param::set(kNode + "/load_image_proc", false);
  ros::param::set(kNode + "/controls/gain_automatic", false);
  ros::param::set(kNode + "/controls/brightness", 100);
  Topic<sensor_msgs::Image> right("camera/right/image_raw");
  Topic<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const NodeProcess node({STEREO_CAPTURE});
  ASSERT_TRUE(comesTrue([&] { return right.messages.size() >= 3; }));
  EXPECT_EQ(right.messages.back()->encoding, "mono8");
  EXPECT_EQ(controlOf("/dev/video0", "brightness"), 100);

  dynamic_reconfigure::Reconfigure change;
  change.request.config.ints.resize(1);
  change.request.config.ints[0].name = "gain";
  change.request.config.ints[0].value = 77;
  ASSERT_TRUE(ros::service::call(kNode + "/set_parameters", change));
  EXPECT_TRUE(comesTrue([] { return controlOf("/dev/video1", "gain") == 77; }));

  {
    camera::V4l2Device device(camera::linuxKernel(), "/dev/video1");
    const auto* disconnect = device.controls().find("disconnect");
    ASSERT_NE(disconnect, nullptr);
    device.controls().set(*disconnect, 1);
  }
  EXPECT_TRUE(comesTrue([&] {
    return diagnosticsText(diagnostics, "Right camera").find("Reconnections: 1") != std::string::npos;
  })) << diagnosticsText(diagnostics, "Right camera");
  const auto before = right.messages.size();
  EXPECT_TRUE(comesTrue([&] { return right.messages.size() >= before + 3; }));
  std::cout << diagnosticsText(diagnostics, "Right camera") << "\n"
            << diagnosticsText(diagnostics, "Stereo pairs") << "\n";
}

}  // namespace
}  // namespace stereo_nav::test
