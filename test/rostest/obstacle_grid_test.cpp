// obstacle_grid nodes whose sensors the test plays, started by obstacle_grid.test.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/image_encodings.h>
#include <std_srvs/Empty.h>
#include <stereo_msgs/DisparityImage.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/angles.h"
#include "rostest/graph_probe.h"
#include "support/ros_wait.h"
#include "unit/navigation/obstacles/drawn_disparity.h"

namespace stereo_nav::test {
namespace {

constexpr double kSeenWall_m = 2.0, kScannedWall_m = 1.5, kRangedWall_m = 1.0;

/// The sensors of a robot in a namespace: a wall ahead before the camera, one to the left that the laser
/// meets, one behind that the range finder meets.
class PlayedSensors {
 public:
  explicit PlayedSensors(const std::string& name) : handle_(name) {
    left_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/left/camera_info", 10, true);
    right_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/right/camera_info", 10, true);
    disparity_ = handle_.advertise<stereo_msgs::DisparityImage>("camera/disparity", 10);
    scan_ = handle_.advertise<sensor_msgs::LaserScan>("scan", 10);
    range_ = handle_.advertise<sensor_msgs::Range>("range/rear", 10);
    obstacles_ = handle_.subscribe<nav_msgs::OccupancyGrid>(
        "obstacles", 10, [this](const nav_msgs::OccupancyGrid::ConstPtr& message) { grid = *message; });
    left_.publish(info(0.0));
    right_.publish(info(-camera_.fx * camera_.baseline_m));
  }

  bool connected() const {
    return disparity_.getNumSubscribers() > 0 && scan_.getNumSubscribers() > 0 &&
           range_.getNumSubscribers() > 0 && obstacles_.getNumPublishers() > 0;
  }

  /// One message of each, with the robot's pose at its stamp.
  void play(const std::string& camera_frame = "camera_left_optical") {
    const ros::Time stamp = ros::Time::now();
    sendTransform(stamp, "odom", "base_link", Eigen::Isometry3d::Identity());
    sendTransform(stamp, "base_link", "camera_left_optical", camera_.T_base_camera);
    sendTransform(stamp, "base_link", "laser", Eigen::Isometry3d::Identity());
    sendTransform(stamp, "base_link", "range_rear",
                  Eigen::Isometry3d(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ())));
    disparity_.publish(disparity(stamp, camera_frame));
    scan_.publish(scan(stamp));
    range_.publish(range(stamp));
  }

  int at(double x, double y) const {
    const auto& info = grid.info;
    const int column = static_cast<int>(std::floor((x - info.origin.position.x) / double{info.resolution}));
    const int row = static_cast<int>(std::floor((y - info.origin.position.y) / double{info.resolution}));
    const std::size_t cell = static_cast<std::size_t>(row) * info.width + static_cast<std::size_t>(column);
    return cell < grid.data.size() ? grid.data[cell] : -2;
  }
  /// Whether something is occupied within 0.1 m of a place.
  bool occupiedNear(double x, double y) const {
    for (double dx = -0.1; dx <= 0.1; dx += 0.05)
      for (double dy = -0.1; dy <= 0.1; dy += 0.05)
        if (at(x + dx, y + dy) == 100) return true;
    return false;
  }

  ros::NodeHandle& handle() { return handle_; }
  nav_msgs::OccupancyGrid grid;

 private:
  void sendTransform(const ros::Time& stamp, const std::string& parent, const std::string& child,
                     const Eigen::Isometry3d& T) {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(T);
    message.header.stamp = stamp;
    message.header.frame_id = parent;
    message.child_frame_id = child;
    broadcaster_.sendTransform(message);
  }

  sensor_msgs::CameraInfo info(double p3) const {
    sensor_msgs::CameraInfo info;
    info.header.frame_id = "camera_left_optical";
    info.width = 320;
    info.height = 240;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    info.K = {camera_.fx, 0.0, camera_.cx, 0.0, camera_.fy, camera_.cy, 0.0, 0.0, 1.0};
    info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    info.P = {camera_.fx, 0.0, camera_.cx, p3, 0.0, camera_.fy, camera_.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
    return info;
  }

  stereo_msgs::DisparityImage disparity(const ros::Time& stamp, const std::string& frame) {
    const cv::Mat map =
        navigation::drawDisparity(camera_, 0.3, ++seed_, [](const auto& origin, const auto& direction) {
          const double t = (kSeenWall_m - origin.x()) / direction.x();
          return std::min(t, navigation::planeAt(0.0, origin, direction));
        });
    stereo_msgs::DisparityImage message;
    message.header.stamp = stamp;
    message.header.frame_id = frame;
    message.image.header = message.header;
    message.image.width = 320;
    message.image.height = 240;
    message.image.encoding = sensor_msgs::image_encodings::TYPE_32FC1;
    message.image.step = 320 * sizeof(float);
    message.image.data.resize(240 * message.image.step);
    std::memcpy(message.image.data.data(), map.data, message.image.data.size());
    message.f = static_cast<float>(camera_.fx);
    message.T = static_cast<float>(camera_.baseline_m);
    message.max_disparity = 63.0F;
    return message;
  }

  static sensor_msgs::LaserScan scan(const ros::Time& stamp) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = stamp;
    scan.header.frame_id = "laser";
    scan.angle_min = static_cast<float>(kPi / 4.0);
    scan.angle_increment = static_cast<float>(kRadPerDeg);
    scan.range_min = 0.1F;
    scan.range_max = 12.0F;
    for (int i = 0; i < 90; ++i)
      scan.ranges.push_back(i < 10
                                ? std::numeric_limits<float>::infinity()
                                : static_cast<float>(kScannedWall_m / std::sin(kPi / 4.0 + i * kRadPerDeg)));
    return scan;
  }

  static sensor_msgs::Range range(const ros::Time& stamp) {
    sensor_msgs::Range range;
    range.header.stamp = stamp;
    range.header.frame_id = "range_rear";
    range.field_of_view = 0.06F;
    range.min_range = 0.1F;
    range.max_range = 12.0F;
    range.range = static_cast<float>(kRangedWall_m);
    return range;
  }

  ros::NodeHandle handle_;
  navigation::DisparityCamera camera_ = navigation::drawnCamera();
  unsigned seed_ = 0;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher left_, right_, disparity_, scan_, range_;
  ros::Subscriber obstacles_;
};

class ObstacleGridNode : public testing::TestWithParam<std::string> {};

TEST_P(ObstacleGridNode, ShowsWhatCameraLaserAndRangeFinderSee) {
  PlayedSensors robot(GetParam());
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  const auto seesAll = [&] {
    robot.play();
    return robot.occupiedNear(kSeenWall_m, 0.2) && robot.occupiedNear(0.0, kScannedWall_m) &&
           robot.occupiedNear(-kRangedWall_m, 0.0);
  };
  EXPECT_TRUE(spinUntil(seesAll, kLongWait_s, 0.05));
  EXPECT_EQ(robot.grid.header.frame_id, "odom");
  EXPECT_EQ(robot.at(1.5, 0.06), 0) << "the floor before the wall";
  EXPECT_EQ(robot.at(2.5, 0.06), -1) << "behind the wall";
  EXPECT_EQ(robot.at(1.2, 1.3), 0) << "where the laser met nothing";

  std_srvs::Empty nothing;
  ASSERT_TRUE(ros::service::call(robot.handle().resolveName("obstacles/clear"), nothing));
  EXPECT_TRUE(spinUntil([&] { return robot.at(1.5, 0.06) == -1; }));
}

TEST_P(ObstacleGridNode, SaysThatAPoseIsMissing) {
  PlayedSensors robot(GetParam());
  GraphProbe probe;
  ASSERT_TRUE(spinUntil([&] { return robot.connected(); }));
  EXPECT_TRUE(spinUntil(
      [&] {
        robot.play("nowhere");
        for (const auto& line : probe.log)
          if (line.find("disparity dropped: no pose of nowhere") != std::string::npos) return true;
        return false;
      },
      kLongWait_s, 0.05));
}

INSTANTIATE_TEST_SUITE_P(NodeAndNodelet, ObstacleGridNode, testing::Values("", "other"));

}  // namespace
}  // namespace stereo_nav::test
