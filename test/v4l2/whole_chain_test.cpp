// Runs inside the virtual machine of vm.sh, beside a ROS master: from the cameras to the odometry.
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>

#include "stereo_nav/ros/recording.h"
#include "stereo_nav/ros/topics.h"
#include "support/node_process.h"
#include "v4l2/feeder.h"
#include "v4l2/ros_probe.h"

namespace stereo_nav::test {
namespace {

using namespace std::chrono_literals;

/// Which image of a drive the two feeders show with each of their frames: the same for both.
class Drive {
 public:
  explicit Drive(std::size_t first) : current_(first) {}

  std::size_t imageOf(std::uint32_t counter) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return shown_.try_emplace(counter, current_).first->second;
  }
  void show(std::size_t index) {
    const std::lock_guard<std::mutex> lock(mutex_);
    current_ = index;
  }

 private:
  std::mutex mutex_;
  std::size_t current_;
  std::map<std::uint32_t, std::size_t> shown_;
};

/// A drive of the simulator, its images through the loopback cameras, the capture node with its nodelets,
/// odometry. The drive goes on when the odometry of its latest image is there: an emulated machine is slow.
TEST(WholeChain, OdometryFromTheCamerasFollowsTheDrive) {
  constexpr auto kPeriod = 500ms;
  const ros_io::Recording recording(SIMULATED_DRIVE, {});
  std::vector<ros_io::RawPair> pairs;
  recording.forEachPair([&pairs](const ros_io::RawPair& pair) {
    pairs.push_back(
        {pair.left_time_s, pair.right_time_s, pair.rolling_shutter_s, pair.left.clone(), pair.right.clone()});
  });
  constexpr std::size_t kFirst = 9;  // the robot stands for two seconds
  ASSERT_GT(pairs.size(), kFirst + 10);
  const int width = pairs[0].left.cols, height = pairs[0].left.rows;

  Drive drive(kFirst);
  camera::Feeder left_feeder("/dev/video10", V4L2_PIX_FMT_GREY, width, height);
  camera::Feeder right_feeder("/dev/video11", V4L2_PIX_FMT_GREY, width, height);
  const auto bytesOf = [](const cv::Mat& image) {
    return std::vector<std::uint8_t>(image.datastart, image.dataend);
  };
  const auto first = std::chrono::steady_clock::now() + 100ms;
  left_feeder.start(first, kPeriod,
                    [&](std::uint32_t counter) { return bytesOf(pairs[drive.imageOf(counter)].left); });
  right_feeder.start(first, kPeriod,
                     [&](std::uint32_t counter) { return bytesOf(pairs[drive.imageOf(counter)].right); });

  tf2_ros::StaticTransformBroadcaster broadcaster;
  const auto T_base_camera = recording.transform(ros_io::frames::kBase, ros_io::frames::kLeftOptical);
  ASSERT_TRUE(T_base_camera);
  geometry_msgs::TransformStamped mounting = tf2::eigenToTransform(*T_base_camera);
  mounting.header.frame_id = ros_io::frames::kBase;
  mounting.child_frame_id = ros_io::frames::kLeftOptical;
  broadcaster.sendTransform(mounting);

  std::filesystem::remove_all("/tmp/ros_home/camera_info");
  setCameras("/dev/video10", "/dev/video11", width, height, 2.0);
  ros::param::set(kNode + "/encoding", "mono8");
  ros::param::set("/visual_odometry/imu", "none");
  Topic<nav_msgs::Odometry> odometry("odom");
  const NodeProcess capture_node({STEREO_CAPTURE});
  ASSERT_TRUE(comesTrue([] { return ros::service::exists("camera/right/set_camera_info", false); }));
  for (const std::string side : {"left", "right"}) {
    sensor_msgs::SetCameraInfo request;
    request.request.camera_info = side == "left" ? recording.leftInfo() : recording.rightInfo();
    ASSERT_TRUE(ros::service::call("camera/" + side + "/set_camera_info", request));
  }
  const NodeProcess odometry_node({VISUAL_ODOMETRY, "__name:=visual_odometry"});
  ASSERT_TRUE(comesTrue([&] { return odometry.messages.size() >= 3; })) << "odometry of the standing robot";

  const double first_s =
      std::chrono::duration<double>(first.time_since_epoch()).count() + rosMinusMonotonic_s();
  const auto imageOfLatest = [&] {
    const double since_s = odometry.messages.back()->header.stamp.toSec() - first_s;
    return drive.imageOf(
        static_cast<std::uint32_t>(std::lround(since_s / std::chrono::duration<double>(kPeriod).count())));
  };
  for (std::size_t index = kFirst; index < pairs.size(); ++index) {
    drive.show(index);
    ASSERT_TRUE(comesTrue([&] { return imageOfLatest() == index; })) << "odometry of image " << index;
  }

  const auto truth = recording.groundTruth(ros_io::topics::kGroundTruth, true).trajectory;
  const auto poseAt = [&truth](double time_s) {
    const auto nearest = std::min_element(truth.begin(), truth.end(), [time_s](const auto& a, const auto& b) {
      return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
    });
    return nearest->T_world_body;
  };
  const Eigen::Isometry3d T_start_end =
      poseAt(pairs[kFirst].left_time_s).inverse() * poseAt(pairs.back().left_time_s);
  const auto& last = odometry.messages.back()->pose.pose.position;
  const double way_m = T_start_end.translation().norm();
  const double error_m = (Eigen::Vector3d(last.x, last.y, last.z) - T_start_end.translation()).norm();
  std::cout << pairs.size() - kFirst << " images, " << odometry.messages.size() << " odometry messages; "
            << way_m << " m driven, error at the end " << error_m << " m\n";
  EXPECT_GT(way_m, 0.5);
  EXPECT_LT(error_m, 0.15 * way_m);
}

}  // namespace
}  // namespace stereo_nav::test
