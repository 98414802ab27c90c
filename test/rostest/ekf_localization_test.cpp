// The ekf_localization node with wheels and a gyroscope that the test plays, started by
// ekf_localization.test.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>
#include <tf2_ros/transform_listener.h>

#include <optional>

#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

class EkfLocalizationNode : public testing::Test {
 protected:
  void SetUp() override {
    wheels_ = handle_.advertise<nav_msgs::Odometry>("wheel/odom", 100);
    imu_ = handle_.advertise<sensor_msgs::Imu>("imu/data", 100);
    set_pose_ = handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>("set_pose", 1);
    filtered_ = handle_.subscribe<nav_msgs::Odometry>(
        "odometry/filtered", 100, [this](const nav_msgs::Odometry::ConstPtr& message) { last_ = *message; });
    ASSERT_TRUE(spinUntil([this] {
      return wheels_.getNumSubscribers() > 0 && imu_.getNumSubscribers() > 0 &&
             set_pose_.getNumSubscribers() > 0 && filtered_.getNumPublishers() > 0;
    }));
  }

  /// One message of each sensor: straight on at `speed_m_s`.
  void play(double speed_m_s) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = ros::Time::now();
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose.orientation.w = 1.0;
    odometry.twist.twist.linear.x = speed_m_s;
    for (std::size_t i = 0; i < 6; ++i) odometry.twist.covariance[7 * i] = 1e-4;
    sensor_msgs::Imu imu;
    imu.header.stamp = odometry.header.stamp;
    imu.header.frame_id = "base_link";
    imu.orientation_covariance[0] = -1.0;
    for (std::size_t i = 0; i < 3; ++i) imu.angular_velocity_covariance[4 * i] = 1e-6;
    imu_.publish(imu);
    wheels_.publish(odometry);
    ros::spinOnce();
    ros::WallDuration(0.02).sleep();
  }

  void playUntil(double speed_m_s, const std::function<bool()>& done) {
    for (int i = 0; i < 1000 && !done(); ++i) play(speed_m_s);
    EXPECT_TRUE(done());
  }

  double x() const { return last_ ? last_->pose.pose.position.x : 0.0; }

  ros::NodeHandle handle_;
  ros::Publisher wheels_, imu_, set_pose_;
  ros::Subscriber filtered_;
  std::optional<nav_msgs::Odometry> last_;
};

TEST_F(EkfLocalizationNode, PublishesThePoseAndItsTransform) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  playUntil(0.5, [this] { return x() > 0.3; });
  EXPECT_EQ(last_->header.frame_id, "odom");
  EXPECT_EQ(last_->child_frame_id, "base_link");
  EXPECT_NEAR(last_->twist.twist.linear.x, 0.5, 0.1);
  EXPECT_GT(last_->pose.covariance[0], 0.0);
  EXPECT_NEAR(last_->pose.pose.position.y, 0.0, 0.02);
  playUntil(0.0, [&buffer] { return buffer.canTransform("odom", "base_link", ros::Time(0)); });
}

TEST_F(EkfLocalizationNode, GoesOnFromThePoseThatIsSetAndBeginsAnewAfterAReset) {
  playUntil(0.0, [this] { return last_.has_value(); });
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "odom";
  pose.pose.pose.position.x = 7.0;
  pose.pose.pose.orientation.w = 1.0;
  set_pose_.publish(pose);
  playUntil(0.0, [this] { return x() > 6.9; });
  std_srvs::Empty empty;
  ASSERT_TRUE(ros::service::call("reset", empty));
  playUntil(0.0, [this] { return x() < 1.0; });
}

TEST_F(EkfLocalizationNode, TakesNothingInWhileItIsSwitchedOff) {
  playUntil(0.0, [this] { return last_.has_value(); });
  std_srvs::SetBool off;
  off.request.data = 0;
  ASSERT_TRUE(ros::service::call("toggle", off));
  play(0.0);
  ros::spinOnce();
  last_.reset();
  for (int i = 0; i < 20; ++i) play(0.0);
  EXPECT_FALSE(last_.has_value());
  std_srvs::Empty empty;
  ASSERT_TRUE(ros::service::call("enable", empty));
  playUntil(0.0, [this] { return last_.has_value(); });
}

}  // namespace
}  // namespace stereo_nav::test
