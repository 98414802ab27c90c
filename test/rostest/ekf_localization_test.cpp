// The ekf_localization node with wheels and a gyroscope that the test plays, started by
// ekf_localization.test.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_srvs/Empty.h>
#include <std_srvs/SetBool.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "ros/bag_file.h"
#include "stereo_nav/core/trajectory.h"
#include "support/command.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

class EkfLocalizationNode : public testing::Test {
 protected:
  void SetUp() override {
    wheels_ = handle_.advertise<nav_msgs::Odometry>("wheel/odom", 100);
    imu_ = handle_.advertise<sensor_msgs::Imu>("imu/data", 100);
    fix_ = handle_.advertise<sensor_msgs::NavSatFix>("fix", 100);
    set_pose_ = handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>("set_pose", 1);
    filtered_ = handle_.subscribe<nav_msgs::Odometry>("odometry/filtered", 100,
                                                      [this](const nav_msgs::Odometry::ConstPtr& message) {
                                                        last_ = *message;
                                                        all_.push_back(*message);
                                                      });
    in_map_ = handle_.subscribe<nav_msgs::Odometry>(
        "outer/odometry/filtered", 100,
        [this](const nav_msgs::Odometry::ConstPtr& message) { last_in_map_ = *message; });
    ASSERT_TRUE(spinUntil([this] {
      return wheels_.getNumSubscribers() > 0 && imu_.getNumSubscribers() > 0 &&
             set_pose_.getNumSubscribers() > 0 && filtered_.getNumPublishers() > 0;
    }));
  }

  /// One message of wheels and gyroscope: at `speed_m_s`, turning with `turn_rad_s`.
  void play(double speed_m_s, double turn_rad_s = 0.0) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = ros::Time::now();
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose.orientation.w = 1.0;
    odometry.twist.twist.linear.x = speed_m_s;
    odometry.twist.twist.angular.z = turn_rad_s;
    for (std::size_t i = 0; i < 6; ++i) odometry.twist.covariance[7 * i] = 1e-4;
    sensor_msgs::Imu imu;
    imu.header.stamp = odometry.header.stamp;
    imu.header.frame_id = "base_link";
    imu.orientation_covariance[0] = -1.0;
    imu.angular_velocity.z = turn_rad_s;
    for (std::size_t i = 0; i < 3; ++i) imu.angular_velocity_covariance[4 * i] = 1e-6;
    imu_.publish(imu);
    wheels_.publish(odometry);
    if (recording_ != nullptr) {
      recording_->write("imu/data", imu.header.stamp, imu);
      recording_->write("wheel/odom", imu.header.stamp, odometry);
    }
    ros::spinOnce();
    ros::WallDuration(0.02).sleep();
  }

  void playUntil(double speed_m_s, const std::function<bool()>& done) {
    for (int i = 0; i < 1000 && !done(); ++i) play(speed_m_s);
    EXPECT_TRUE(done());
  }

  /// The robot is where it was at its first fix, to a centimetre.
  void playFix() {
    sensor_msgs::NavSatFix fix;
    fix.header.stamp = ros::Time::now();
    fix.header.frame_id = "base_link";
    for (std::size_t i = 0; i < 3; ++i) fix.position_covariance[4 * i] = 1e-4;
    fix_.publish(fix);
  }

  double x() const { return last_ ? last_->pose.pose.position.x : 0.0; }

  ros::NodeHandle handle_;
  ros::Publisher wheels_, imu_, fix_, set_pose_;
  ros::Subscriber filtered_, in_map_;
  std::optional<nav_msgs::Odometry> last_, last_in_map_;
  std::vector<nav_msgs::Odometry> all_;
  ros_io::BagFile* recording_ = nullptr;  ///< of what is played
};

/// Where a trajectory is at a time; nothing outside of it.
std::optional<Eigen::Vector3d> placeAt(const Trajectory& trajectory, double time_s) {
  const auto later = std::find_if(trajectory.begin(), trajectory.end(),
                                  [time_s](const StampedPose& pose) { return pose.time_s >= time_s; });
  if (later == trajectory.begin() || later == trajectory.end()) return std::nullopt;
  const auto before = std::prev(later);
  const double share = (time_s - before->time_s) / (later->time_s - before->time_s);
  return (1.0 - share) * before->T_world_body.translation() + share * later->T_world_body.translation();
}

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

TEST_F(EkfLocalizationNode, IsWhereFuseIsOnTheRecordingOfTheSameMessages) {
  playUntil(0.0, [this] { return last_.has_value(); });
  // What was sent before may still be on its way, and would begin the filter anew before the recording
  // begins.
  ros::WallDuration(0.3).sleep();
  std_srvs::Empty empty;
  ASSERT_TRUE(ros::service::call("reset", empty));
  ros::spinOnce();
  all_.clear();
  const std::string folder =
      std::filesystem::temp_directory_path() / ("live_and_fuse." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  ros_io::BagFile bag(folder + "/played.bag");
  recording_ = &bag;
  for (int i = 0; i < 75; ++i) play(std::min(0.5, 0.01 * i), std::min(0.6, 0.012 * i));
  bag.commit();
  recording_ = nullptr;
  const CommandResult fused = runCommand(FUSE " " + folder + "/played.bag --output " + folder + "/fused");
  ASSERT_EQ(fused.status, 0) << fused.output;
  const Trajectory offline = readTum(folder + "/fused/trajectory.tum");
  double largest_m = 0.0;
  int compared = 0;
  for (const nav_msgs::Odometry& live : all_) {
    const auto place = placeAt(offline, live.header.stamp.toSec());
    if (!place) continue;
    const auto& p = live.pose.pose.position;
    largest_m = std::max(largest_m, (*place - Eigen::Vector3d(p.x, p.y, p.z)).norm());
    ++compared;
  }
  EXPECT_GT(compared, 20);
  EXPECT_LT(largest_m, 0.001);
  std::filesystem::remove_all(folder);
}

TEST_F(EkfLocalizationNode, AnOuterFilterWithGnssPublishesMapToOdom) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(spinUntil([this] { return fix_.getNumSubscribers() > 0 && in_map_.getNumPublishers() > 0; }));
  playFix();
  const double start_m = x();
  playUntil(0.5, [&] { return x() > start_m + 0.3; });
  const auto at = [&buffer](const char* parent, const char* child) {
    return buffer.lookupTransform(parent, child, ros::Time(0)).transform.translation.x;
  };
  // At rest, and the fixes say that it is at the origin of the map.
  playUntil(0.0, [&] {
    playFix();
    return buffer.canTransform("map", "base_link", ros::Time(0)) && std::abs(at("map", "base_link")) < 0.1;
  });
  ASSERT_TRUE(last_in_map_);
  EXPECT_EQ(last_in_map_->header.frame_id, "map");
  EXPECT_NEAR(last_in_map_->pose.pose.position.x, 0.0, 0.15);
  EXPECT_NEAR(at("map", "odom"), -at("odom", "base_link"), 0.15);
  EXPECT_GT(std::abs(at("odom", "base_link")), 0.3);
}

}  // namespace
}  // namespace stereo_nav::test
