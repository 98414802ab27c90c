// The range_correction node in the map hall.yaml, started by range_correction.test.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Range.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <set>

#include "rostest/graph_probe.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

const char* const kFinders[4] = {"front", "left", "rear", "right"};

/// A robot that stands at (2, 1.2) m in the hall of 7.8 by 4.8 m, whose odometry says (5, 0) m.
class RangeCorrectionNode : public testing::Test {
 protected:
  void SetUp() override {
    for (std::size_t i = 0; i < 4; ++i)
      ranges_[i] = handle_.advertise<sensor_msgs::Range>(std::string("range/") + kFinders[i], 10);
    initial_pose_ = handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
    pose_subscriber_ = handle_.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
        "range/pose", 10,
        [this](const geometry_msgs::PoseWithCovarianceStamped::ConstPtr& message) { pose_ = *message; });
    transforms_ = handle_.subscribe<tf2_msgs::TFMessage, const ros::MessageEvent<const tf2_msgs::TFMessage>&>(
        "/tf", 100, [this](const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
          if (event.getPublisherName() != "/range_correction") return;
          for (const auto& transform : event.getMessage()->transforms)
            children_.insert(transform.child_frame_id);
        });
    ASSERT_TRUE(spinUntil([this] {
      for (const ros::Publisher& range : ranges_)
        if (range.getNumSubscribers() == 0) return false;
      return initial_pose_.getNumSubscribers() > 0 && pose_subscriber_.getNumPublishers() > 0;
    }));
  }

  void send(const ros::Time& stamp, const std::string& parent, const std::string& child,
            const Eigen::Isometry3d& T) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T);
    transform.header.stamp = stamp;
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    broadcaster_.sendTransform(transform);
  }

  /// One reading of each range finder, 0.2 m before, left, behind and right of the middle.
  void play(double front_m) {
    const ros::Time stamp = ros::Time::now();
    send(stamp, "odom", "base_link", Eigen::Isometry3d(Eigen::Translation3d(5.0, 0.0, 0.0)));
    const double metres[4] = {front_m, 3.4, 1.8, 1.0};
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::AngleAxisd turn(0.5 * M_PI * static_cast<double>(i), Eigen::Vector3d::UnitZ());
      const std::string frame = std::string("range_") + kFinders[i];
      send(stamp, "base_link", frame, turn * Eigen::Translation3d(0.2, 0.0, 0.1));
      sensor_msgs::Range range;
      range.header.stamp = stamp;
      range.header.frame_id = frame;
      range.radiation_type = sensor_msgs::Range::INFRARED;
      range.field_of_view = 0.063F;
      range.min_range = 0.1F;
      range.max_range = 12.0F;
      range.range = static_cast<float>(metres[i]);
      ranges_[i].publish(range);
    }
    ros::spinOnce();
    ros::WallDuration(0.02).sleep();
  }

  bool playUntil(double front_m, const std::function<bool()>& done) {
    for (int i = 0; i < 2000 && !done(); ++i) play(front_m);
    return done();
  }

  ros::NodeHandle handle_;
  ros::Publisher ranges_[4], initial_pose_;
  ros::Subscriber pose_subscriber_, transforms_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::optional<geometry_msgs::PoseWithCovarianceStamped> pose_;
  std::set<std::string> children_;
};

TEST_F(RangeCorrectionNode, FindsThePlaceAndMovesTheMapNotTheOdometry) {
  const auto isThere = [this] {
    return pose_ && std::hypot(pose_->pose.pose.position.x - 2.0, pose_->pose.pose.position.y - 1.2) < 0.03;
  };
  ASSERT_TRUE(playUntil(5.6, isThere));
  EXPECT_EQ(pose_->header.frame_id, "map");
  EXPECT_GT(pose_->pose.covariance[0], 0.0);
  EXPECT_LT(pose_->pose.covariance[0], 0.01);
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(playUntil(5.6, [&buffer] { return buffer.canTransform("map", "odom", ros::Time(0)); }));
  const auto T_map_odom = buffer.lookupTransform("map", "odom", ros::Time(0)).transform.translation;
  EXPECT_NEAR(T_map_odom.x, -3.0, 0.05);
  EXPECT_NEAR(T_map_odom.y, 1.2, 0.05);
  ASSERT_TRUE(playUntil(5.6, [this] { return !children_.empty(); }));
  EXPECT_EQ(children_, std::set<std::string>{"odom"});
}

TEST_F(RangeCorrectionNode, NamesTheRangeFinderThatMeetsNoWall) {
  GraphProbe probe;
  // At rest a range finder that has measured is not asked again, unless the pose is set.
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  pose.pose.pose.position.x = 2.0;
  pose.pose.pose.position.y = 1.2;
  pose.pose.pose.orientation.w = 1.0;
  for (const std::size_t i : {0u, 7u, 35u}) pose.pose.covariance[i] = 0.0025;
  initial_pose_.publish(pose);
  const auto isNamed = [&probe] {
    for (const std::string& text : probe.log)
      if (text.find("range/front: 20 measurements in succession that no wall") != std::string::npos)
        return true;
    return false;
  };
  EXPECT_TRUE(playUntil(2.5, isNamed));
}

TEST_F(RangeCorrectionNode, NamesAnOdometryThatIsNotTheOneOfTheTransform) {
  GraphProbe probe;
  const ros::Publisher publisher = handle_.advertise<nav_msgs::Odometry>("odometry/filtered", 1);
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "laser_odom";
  odometry.child_frame_id = "base_link";
  const auto isNamed = [&] {
    publisher.publish(odometry);
    for (const std::string& text : probe.log)
      if (text.find("they are of base_link in laser_odom, tf is asked for base_link in odom") !=
          std::string::npos)
        return true;
    return false;
  };
  EXPECT_TRUE(playUntil(5.6, isNamed));
}

}  // namespace
}  // namespace stereo_nav::test
