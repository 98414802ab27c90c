// main() of test programs that are ROS nodes. What starts them gives the node's name, `__name:=`, as rostest
// does with the name of the test, and chooses among the program's tests by `--gtest_filter`.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstdio>
#include <optional>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "stereo_nav_test");
  ros::Time::init();
  // Otherwise the node would end with the first test, and no other one could follow. Where a test starts the
  // master itself it has to be the only one.
  std::optional<ros::NodeHandle> keeps_ros_running;
  if (ros::master::check()) keeps_ros_running.emplace();
  const int status = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() > 0) return status;
  std::fprintf(stderr, "no test of this program has a name that --gtest_filter lets through\n");
  return 1;
}
