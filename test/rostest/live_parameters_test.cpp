// What dynamic_reconfigure's clients see of the live parameters, and what reaches the node. Started by
// live_parameters.test.
#include "ros/live_parameters.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <limits>

#include "nodes/visual_odometry/visual_odometry_params.h"
#include "ros/capture_setup.h"
#include "ros/imu_bridge_params.h"
#include "rostest/reconfigure.h"
#include "support/command.h"
#include "support/wait.h"

namespace stereo_nav::test {
namespace {

/// Stands for a node; its callback takes what comes.
template <class Params>
struct Node {
  explicit Node(const std::string& name, const Params& params = Params())
      : live(ros::NodeHandle(name), params, [this](const Params& changed) {
          received = changed;
          ++changes;
        }) {
    spinner.start();
  }
  Params received;
  int changes = 0;
  ros_io::LiveParameters<Params> live;
  ros::AsyncSpinner spinner{1};  ///< the requests come from the thread of the test
};

template <class Params>
class LiveParameters : public ::testing::Test {};
using AllParams =
    ::testing::Types<nodes::VisualOdometryParams, ros_io::ImuBridgeParams, ros_io::StereoCaptureParams>;
TYPED_TEST_SUITE(LiveParameters, AllParams);

TYPED_TEST(LiveParameters, TheDescriptionIsThatOfTheParameters) {
  const Node<TypeParam> node("/described");
  const auto parameters = LiveParameterList::of(TypeParam());
  ASSERT_GE(parameters.size(), 3u);
  std::map<std::string, std::size_t> counts;
  for (const auto& parameter : parameters) {
    SCOPED_TRACE(parameter.name);
    ++counts[parameter.section];
    const auto description = ros::topic::waitForMessage<dynamic_reconfigure::ConfigDescription>(
        "/described" + parameter.section + "/parameter_descriptions", ros::Duration(kLongWait_s));
    ASSERT_TRUE(description);
    EXPECT_EQ(valuesOf(description->dflt).at(parameter.name), parameter.value);
    EXPECT_EQ(valuesOf(description->min).at(parameter.name), parameter.min);
    EXPECT_EQ(valuesOf(description->max).at(parameter.name), parameter.max);
    ASSERT_EQ(description->groups.size(), 1u);
    bool found = false;
    for (const auto& offered : description->groups[0].parameters) {
      if (offered.name != parameter.name) continue;
      found = true;
      const std::string type =
          std::vector<std::string>{"bool", "int", "double", "str"}[parameter.value.index()];
      EXPECT_EQ(offered.type, type);
      EXPECT_FALSE(offered.description.empty());
    }
    EXPECT_TRUE(found);
  }
  for (const auto& count : counts) {
    const auto description = ros::topic::waitForMessage<dynamic_reconfigure::ConfigDescription>(
        "/described" + count.first + "/parameter_descriptions", ros::Duration(kLongWait_s));
    ASSERT_TRUE(description);
    EXPECT_EQ(description->groups[0].parameters.size(), count.second) << "nothing that is not live";
  }
}

TYPED_TEST(LiveParameters, EachCanBeSetAndReachesTheNode) {
  const Node<TypeParam> node("/set");
  EXPECT_EQ(node.changes, 1) << "told at the start";
  const auto before = LiveParameterList::of(TypeParam());
  for (std::size_t i = 0; i < before.size(); ++i) {
    SCOPED_TRACE(before[i].name);
    const bool is_flag = std::holds_alternative<bool>(before[i].value);
    const Value wanted = is_flag ? Value(!std::get<bool>(before[i].value)) : before[i].max;
    const auto response = reconfigure("/set" + before[i].section, {{before[i].name, wanted}});
    ASSERT_TRUE(response);
    EXPECT_EQ(response->at(before[i].name), wanted);
    EXPECT_EQ(LiveParameterList::of(node.received)[i].value, wanted) << "reaches the node";
    XmlRpc::XmlRpcValue stored;
    EXPECT_TRUE(ros::param::get("/set" + before[i].section + "/" + before[i].name, stored));
    const auto told = ros::topic::waitForMessage<dynamic_reconfigure::Config>(
        "/set" + before[i].section + "/parameter_updates", ros::Duration(kLongWait_s));
    ASSERT_TRUE(told);
    EXPECT_EQ(valuesOf(*told).at(before[i].name), wanted);
  }
  EXPECT_EQ(node.changes, 1 + static_cast<int>(before.size()));
}

TEST(LiveParameter, ValuesOfTheStartAreKept) {
  ros_io::ImuBridgeParams params;
  params.yaw_stddev_rad = 0.07;
  const Node<ros_io::ImuBridgeParams> node("/started", params);
  EXPECT_EQ(node.received.yaw_stddev_rad, 0.07);
  const auto response = reconfigure("/started", {{"tilt_stddev_rad", 0.5}});
  ASSERT_TRUE(response);
  EXPECT_EQ(response->at("yaw_stddev_rad"), Value(0.07));
  EXPECT_EQ(node.received.yaw_stddev_rad, 0.07);
  EXPECT_EQ(node.received.port, params.port);
}

TEST(LiveParameter, AValueOutOfRangeBecomesTheNearestAllowedOne) {
  const Node<ros_io::StereoCaptureParams> node("/clamped");
  const auto response = reconfigure("/clamped", {{"gain", 20000}, {"exposure_ms", -7.0}});
  ASSERT_TRUE(response);
  EXPECT_EQ(response->at("gain"), Value(10000));
  EXPECT_EQ(response->at("exposure_ms"), Value(-1.0));
  EXPECT_EQ(node.received.capture.gain, 10000);
}

TEST(LiveParameter, WhatIsNoNumberIsRefusedAndChangesNothing) {
  const Node<ros_io::StereoCaptureParams> node("/refusing");
  EXPECT_FALSE(
      reconfigure("/refusing", {{"gain", 5}, {"exposure_ms", std::numeric_limits<double>::quiet_NaN()}}));
  EXPECT_EQ(node.received.capture.gain, -1);
  EXPECT_EQ(node.changes, 1);
}

TEST(LiveParameter, WhatIsNotLiveStaysAndTheRestIsTaken) {
  const Node<ros_io::StereoCaptureParams> node("/mixed");
  const auto response = reconfigure("/mixed", {{"gain", 5}, {"width", 1280}, {"max_time_offset_s", 1}});
  ASSERT_TRUE(response);
  EXPECT_EQ(response->count("width"), 0u);
  EXPECT_EQ(node.received.capture.width, 640);
  EXPECT_EQ(node.received.capture.max_time_offset_s, 0.02) << "a whole number is of another type";
  EXPECT_EQ(node.received.capture.gain, 5);
}

enum class Shape { kRound, kSquare };

/// No node has live parameters of these types yet.
struct TextParams {
  std::string label = "a";
  Shape shape = Shape::kRound;
  void describe(ParameterVisitor& visitor) {
    visitor.text("label", label, "a text", Change::kLive);
    visitEnum(visitor, "shape", shape, {{"round", Shape::kRound}, {"square", Shape::kSquare}}, "a choice",
              Change::kLive);
  }
};

TEST(LiveParameter, TextsAndChoices) {
  const Node<TextParams> node("/texts");
  ASSERT_TRUE(reconfigure("/texts", {{"label", std::string("b")}, {"shape", std::string("square")}}));
  EXPECT_EQ(node.received.label, "b");
  EXPECT_EQ(node.received.shape, Shape::kSquare);
  EXPECT_FALSE(reconfigure("/texts", {{"label", std::string("c")}, {"shape", std::string("oval")}}));
  EXPECT_EQ(node.received.label, "b");
}

TEST(LiveParameter, TheCommandLineClientWorks) {
  const Node<nodes::VisualOdometryParams> node("/dynparam");
  const auto dynparam = [](const std::string& arguments) {
    return runCommand("PATH=/usr/bin:$PATH timeout 60 rosrun dynamic_reconfigure dynparam " + arguments);
  };
  const auto set = dynparam("set /dynparam publish_tf false");
  EXPECT_EQ(set.status, 0) << set.output;
  EXPECT_FALSE(node.received.publish_tf);
  const auto got = dynparam("get /dynparam");
  EXPECT_NE(got.output.find("'publish_tf': False"), std::string::npos) << got.output;
  const auto below = dynparam("set /dynparam/uncertainty lost_speed_m_s 2.5");
  EXPECT_EQ(below.status, 0) << below.output;
  EXPECT_EQ(node.received.uncertainty.lost_speed_m_s, 2.5);
}

}  // namespace
}  // namespace stereo_nav::test
