#include "ros/parameter_server.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "nodes/visual_odometry/visual_odometry_params.h"
#include "support/command.h"

namespace stereo_nav::ros_io {
namespace {

TEST(ParameterServer, ValuesOfAllTypesReachTheParameters) {
  XmlRpc::XmlRpcValue tree;
  tree["base_frame"] = "base_footprint";
  tree["publish_tf"] = false;
  tree["imu"] = "none";
  tree["path_spacing_m"] = 0.1 + 0.2;  // not exact in few digits
  tree["synchronisation"]["queue_size"] = 7;
  tree["waiting"]["imu_wait_s"] = 0;  // a whole number where a real one is meant
  nodes::VisualOdometryParams params;
  stereo_nav::readParameters(toYaml(tree), "/visual_odometry", params);
  EXPECT_EQ(params.base_frame, "base_footprint");
  EXPECT_FALSE(params.publish_tf);
  EXPECT_EQ(params.imu, nodes::VisualOdometryParams::Imu::kNone);
  EXPECT_EQ(params.path_spacing_m, 0.1 + 0.2);
  EXPECT_EQ(params.synchronisation.queue_size, 7);
  EXPECT_EQ(params.waiting.imu_wait_s, 0.0);
}

TEST(ParameterServer, UnknownNamesAreRefused) {
  XmlRpc::XmlRpcValue tree;
  tree["bas_frame"] = "base_link";
  nodes::VisualOdometryParams params;
  EXPECT_THROW(stereo_nav::readParameters(toYaml(tree), "/visual_odometry", params), ParameterError);
}

#ifdef PARAMETERS_PROGRAM  // of a build with all parts
TEST(ParameterReference, IsWhatTheNodesCheck) {
  std::ifstream file(std::string(STEREO_NAV_SOURCE_DIR) + "/docs/parameters.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), test::runCommand(PARAMETERS_PROGRAM).output)
      << "to renew it: rosrun stereo_nav parameters > docs/parameters.md";
}
#endif

TEST(ParameterServer, ArraysKeepTheirOrder) {
  XmlRpc::XmlRpcValue list;
  list[0] = 3;
  list[1] = "four";
  const YAML::Node node = toYaml(list);
  ASSERT_TRUE(node.IsSequence());
  EXPECT_EQ(node[0].as<int>(), 3);
  EXPECT_EQ(node[1].as<std::string>(), "four");
}

}  // namespace
}  // namespace stereo_nav::ros_io
