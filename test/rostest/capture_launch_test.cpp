// The capture node as capture.launch starts it, without cameras: it stays up and says what is missing.
// Started by capture.test.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <set>

#include "rostest/diagnostics_probe.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

/// What the capture node of a rig says in its diagnostics.
class CaptureDiagnostics {
 public:
  explicit CaptureDiagnostics(const std::string& rig) : node_(rig + "/stereo_capture: ") {}

  std::string textOf(const std::string& part) const { return probe_.textOf(node_ + part); }
  bool says(const std::string& part, const std::string& text) const {
    return probe_.says(node_ + part, text);
  }

 private:
  const std::string node_;
  const DiagnosticsProbe probe_;
};

TEST(CaptureLaunch, TheNodeStaysUpAndNamesTheMissingCameras) {
  const CaptureDiagnostics diagnostics("rig");
  for (const std::string side : {"left", "right"}) {
    const std::string part = side == "left" ? "Left camera" : "Right camera";
    EXPECT_TRUE(spinUntil([&] { return diagnostics.says(part, "no-" + side + "-camera"); }))
        << diagnostics.textOf(part);
    EXPECT_TRUE(diagnostics.says(part, "no such device now; is the camera plugged in?"))
        << diagnostics.textOf(part);
  }
  // It goes on trying.
  EXPECT_TRUE(spinUntil([&] {
    const std::string text = diagnostics.textOf("Left camera");
    const auto at = text.find("Failed attempts: ");
    return at != std::string::npos && std::stoi(text.substr(at + 17)) >= 3;
  })) << diagnostics.textOf("Left camera");
  EXPECT_TRUE(diagnostics.says("Stereo pairs", "No pairs"));
}

TEST(CaptureLaunch, EveryTopicAndParameterIsUnderTheNamespace) {
  std::set<std::string> topics;
  const auto advertised = [&] {
    ros::master::V_TopicInfo infos;
    ros::master::getTopics(infos);
    for (const auto& info : infos) topics.insert(info.name);
    return topics.count("/rig/camera/disparity") == 1;
  };
  ASSERT_TRUE(spinUntil(advertised));
  for (const std::string side : {"left", "right"}) {
    for (const std::string topic : {"image_raw", "camera_info", "image_rect", "image_rect_color"}) {
      EXPECT_EQ(topics.count("/rig/camera/" + side + "/" + topic), 1u) << side << " " << topic;
    }
  }
  EXPECT_EQ(topics.count("/rig/camera/sync"), 1u);
  int range = 0;
  EXPECT_TRUE(ros::param::get("/rig/stereo_capture_disparity/disparity_range", range))
      << "config/disparity.yaml";
  EXPECT_GT(range, 0);
  double max_time_offset_s = 0.0;
  EXPECT_TRUE(ros::param::get("/rig/stereo_capture/max_time_offset_s", max_time_offset_s))
      << "config/capture.yaml";
  EXPECT_EQ(max_time_offset_s, 0.0167);
}

TEST(CaptureLaunch, ACalibrationOfTheWrongSizeAndAMissingOneAreNamed) {
  const CaptureDiagnostics diagnostics("rig");
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("Left camera", "is for 320x240 images, the camera gives 640x480");
  })) << diagnostics.textOf("Left camera");
  EXPECT_TRUE(diagnostics.says("Left camera", "package://stereo_nav/config/thesis/left.yaml"));
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("Right camera",
                            "no calibration: package://stereo_nav/config/thesis/no_such_file.yaml");
  })) << diagnostics.textOf("Right camera");
}

TEST(CaptureLaunch, APortWithoutCameraIsNamed) {
  const CaptureDiagnostics diagnostics("spare");
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("Left camera", "usb-no-left-port: no camera at this port (connected: ");
  })) << diagnostics.textOf("Left camera");
}

TEST(CaptureLaunch, ACalibrationThatCannotBeReadAndAnImpossibleUrlAreNamed) {
  const CaptureDiagnostics diagnostics("spare");
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("Left camera",
                            "package://stereo_nav/config/capture.yaml is missing or cannot be read");
  })) << diagnostics.textOf("Left camera");
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("Right camera", "the calibration URL right.yaml is not of the form file:///path");
  })) << diagnostics.textOf("Right camera");
}

// Each is good alone; together they have no baseline.
TEST(CaptureLaunch, TwoCalibrationsThatMakeNoPairAreNamed) {
  const CaptureDiagnostics diagnostics("twice");
  EXPECT_TRUE(spinUntil([&] { return diagnostics.says("Stereo pairs", "baseline"); }))
      << diagnostics.textOf("Stereo pairs");
  EXPECT_FALSE(diagnostics.says("Left camera", "no calibration"));
}

}  // namespace
}  // namespace stereo_nav::test
