// Odometry in the simulated arena with the IMU on a serial line, started by imu_arena.test.
#include <gtest/gtest.h>
#include <sensor_msgs/Imu.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "rostest/graph_probe.h"
#include "sensors/imu/module_angles.h"

namespace stereo_nav::test {
namespace {

constexpr double kArena_s = 200.0;  // the drive takes 30 s; the rest is for a loaded machine

double headingOf(const geometry_msgs::Quaternion& q) {
  return imu::heading({q.w, q.x, q.y, q.z}) / kDegree;
}

TEST(ImuArena, TheHeadingTurnsTheRightWayAndThePathIsRight) {
  ros::NodeHandle handle;
  GraphProbe probe;
  std::vector<sensor_msgs::Imu> imu;
  const ros::Subscriber subscriber = handle.subscribe<sensor_msgs::Imu>(
      "imu/data", 10000, [&](const sensor_msgs::Imu::ConstPtr& message) { imu.push_back(*message); });
  // The course ends at (8, -3), after the only crossing of y = -2.9.
  const auto arrived = [&] {
    return !probe.ground_truth.empty() && probe.ground_truth.back().pose.pose.position.y < -2.98 &&
           !probe.odometry.empty() &&
           probe.ground_truth.back().header.stamp - probe.odometry.back().header.stamp < ros::Duration(0.25);
  };
  ASSERT_TRUE(spinUntil(arrived, kArena_s)) << probe.odometry.size() << " frames of odometry";

  const nav_msgs::Odometry& end = probe.odometry.back();
  const auto truth = std::find_if(probe.ground_truth.begin(), probe.ground_truth.end(), [&](const auto& t) {
    return std::abs((t.header.stamp - end.header.stamp).toSec()) < 1e-3;
  });
  ASSERT_NE(truth, probe.ground_truth.end());
  std::printf("end of the odometry %.3f m off, heading %.2f deg, truth %.2f deg\n", distance(end, *truth),
              headingOf(end.pose.pose.orientation), headingOf(truth->pose.pose.orientation));
  EXPECT_LT(distance(end, *truth), 0.35) << "3 % of the course";
  EXPECT_NEAR(headingOf(end.pose.pose.orientation), headingOf(truth->pose.pose.orientation), 3.0);
  EXPECT_LT(headingOf(truth->pose.pose.orientation), -80.0) << "the course turns right";

  // The bridge alone: the heading counts from the module's power-on, so only its change is compared.
  ASSERT_GT(imu.size(), 2000U);
  const double turned = wrapDegrees(headingOf(imu.back().orientation) - headingOf(imu.front().orientation));
  EXPECT_NEAR(turned, headingOf(probe.ground_truth.back().pose.pose.orientation), 3.0);
}

}  // namespace
}  // namespace stereo_nav::test
