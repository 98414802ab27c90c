// The capture node as capture.launch starts it, without cameras: it stays up and says what is missing.
// Started by capture.test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <functional>
#include <map>
#include <set>

namespace stereo_nav::test {
namespace {

constexpr double kLongWait_s = 60.0;  // for a loaded machine; nothing waits this long otherwise

bool waitUntil(const std::function<bool()>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kLongWait_s);
  while (ros::ok() && !condition()) {
    if (ros::WallTime::now() > end) return false;
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return ros::ok();
}

/// The newest of each of the states of a rig's capture node, by the end of their names.
class Diagnostics {
 public:
  explicit Diagnostics(const std::string& rig) : node_(rig + "/stereo_capture: ") {}

  std::string textOf(const std::string& part) const {
    const auto found = states_.find(part);
    if (found == states_.end()) return {};
    std::string text = found->second.message;
    for (const auto& value : found->second.values) text += "\n" + value.key + ": " + value.value;
    return text;
  }
  bool says(const std::string& part, const std::string& text) const {
    return textOf(part).find(text) != std::string::npos;
  }

 private:
  void add(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    for (const auto& state : message->status) {
      if (state.name.compare(0, node_.size(), node_) == 0) states_[state.name.substr(node_.size())] = state;
    }
  }

  const std::string node_;
  ros::NodeHandle handle_;
  ros::Subscriber subscriber_ = handle_.subscribe("/diagnostics", 100, &Diagnostics::add, this);
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> states_;
};

TEST(CaptureLaunch, TheNodeStaysUpAndNamesTheMissingCameras) {
  const Diagnostics diagnostics("rig");
  for (const std::string side : {"left", "right"}) {
    const std::string part = side == "left" ? "Left camera" : "Right camera";
    EXPECT_TRUE(waitUntil([&] { return diagnostics.says(part, "no-" + side + "-camera"); }))
        << diagnostics.textOf(part);
    EXPECT_TRUE(diagnostics.says(part, "no such device now; is the camera plugged in?"))
        << diagnostics.textOf(part);
  }
  // It goes on trying.
  EXPECT_TRUE(waitUntil([&] {
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
  ASSERT_TRUE(waitUntil(advertised));
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
  const Diagnostics diagnostics("rig");
  EXPECT_TRUE(waitUntil([&] {
    return diagnostics.says("Left camera", "is for 320x240 images, the camera gives 640x480");
  })) << diagnostics.textOf("Left camera");
  EXPECT_TRUE(diagnostics.says("Left camera", "package://stereo_nav/config/thesis/left.yaml"));
  EXPECT_TRUE(waitUntil([&] {
    return diagnostics.says("Right camera",
                            "no calibration: package://stereo_nav/config/thesis/no_such_file.yaml");
  })) << diagnostics.textOf("Right camera");
}

TEST(CaptureLaunch, APortWithoutCameraIsNamed) {
  const Diagnostics diagnostics("spare");
  EXPECT_TRUE(waitUntil([&] {
    return diagnostics.says("Left camera", "usb-no-left-port: no camera at this port (connected: ");
  })) << diagnostics.textOf("Left camera");
}

TEST(CaptureLaunch, ACalibrationThatCannotBeReadAndAnImpossibleUrlAreNamed) {
  const Diagnostics diagnostics("spare");
  EXPECT_TRUE(waitUntil([&] {
    return diagnostics.says("Left camera",
                            "package://stereo_nav/config/capture.yaml is missing or cannot be read");
  })) << diagnostics.textOf("Left camera");
  EXPECT_TRUE(waitUntil([&] {
    return diagnostics.says("Right camera", "the calibration URL right.yaml is not of the form file:///path");
  })) << diagnostics.textOf("Right camera");
}

}  // namespace
}  // namespace stereo_nav::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "capture_launch_test");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
