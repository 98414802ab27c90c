// The visual_odometry node alone, fed by the test: its explanations, its services, its images.
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Empty.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <utility>

#include "core/optical_axes.h"
#include "rostest/graph_probe.h"
#include "stereo_nav/SetPose.h"
#include "support/fixture_bag.h"
#include "support/room_frame.h"
#include "support/textured_room.h"

namespace stereo_nav::test {
namespace {

constexpr double kPeriod_s = 0.1;

/// Plays the drive through the room to and fro, with the faults that it is told to have.
class Rig {
 public:
  Rig() {
    constexpr int kFrames = 8;
    for (int i = 0; i < kFrames; ++i) frames_.push_back(roomFrame(kPeriod_s * i, ros::Time()));
    timer_ = handle_.createWallTimer(ros::WallDuration(kPeriod_s), &Rig::publish, this);
  }

  bool with_disparity = true;
  bool swapped = false;
  std::string right_frame_id = "camera_left_optical";
  double right_stamp_offset_s = 0.0;

 private:
  void publish(const ros::WallTimerEvent&) {
    const auto period = 2 * static_cast<int>(frames_.size()) - 2;
    const int phase = index_++ % period;
    const int at = phase < static_cast<int>(frames_.size()) ? phase : period - phase;
    RoomFrame frame = withStamp(frames_[static_cast<std::size_t>(at)], ros::Time::now());
    if (swapped) std::swap(frame.left, frame.right);
    sensor_msgs::CameraInfo left_info = cameraInfo(roomCalibration(), false);
    sensor_msgs::CameraInfo right_info = cameraInfo(roomCalibration(), true);
    left_info.header.stamp = frame.left->header.stamp;
    frame.right->header.stamp += ros::Duration(right_stamp_offset_s);
    right_info.header.stamp = frame.right->header.stamp;
    frame.right->header.frame_id = right_info.header.frame_id = right_frame_id;
    left_info_.publish(left_info);
    right_info_.publish(right_info);
    left_.publish(frame.left);
    right_.publish(frame.right);
    if (with_disparity) disparity_.publish(frame.disparity);
  }

  ros::NodeHandle handle_;
  ros::Publisher left_ = handle_.advertise<sensor_msgs::Image>("camera/left/image_rect", 5);
  ros::Publisher right_ = handle_.advertise<sensor_msgs::Image>("camera/right/image_rect", 5);
  ros::Publisher disparity_ = handle_.advertise<stereo_msgs::DisparityImage>("camera/disparity", 5);
  ros::Publisher left_info_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/left/camera_info", 5);
  ros::Publisher right_info_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/right/camera_info", 5);
  std::vector<RoomFrame> frames_;
  int index_ = 0;
  ros::WallTimer timer_;
};

class OdometryNode : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig_ = std::make_unique<Rig>();
    probe_ = std::make_unique<GraphProbe>();
    mounting_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
  }
  static void TearDownTestSuite() {
    rig_.reset();
    probe_.reset();
    mounting_.reset();
  }

  void SetUp() override { probe_->forget(); }

  static void publishMounting() {
    Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
    T_base_camera.linear() = opticalToBody();
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_base_camera);
    transform.header.frame_id = "base_link";
    transform.child_frame_id = "camera_left_optical";
    mounting_->sendTransform(transform);
  }

  static bool isTracking() {
    return !probe_->status.empty() && probe_->status.back().state == VoStatus::TRACKING;
  }
  static bool waitForTracking() {
    probe_->status.clear();
    return spinUntil(isTracking);
  }

  static std::unique_ptr<Rig> rig_;
  static std::unique_ptr<GraphProbe> probe_;
  static std::unique_ptr<tf2_ros::StaticTransformBroadcaster> mounting_;
};

std::unique_ptr<Rig> OdometryNode::rig_;
std::unique_ptr<GraphProbe> OdometryNode::probe_;
std::unique_ptr<tf2_ros::StaticTransformBroadcaster> OdometryNode::mounting_;

// This test is the first one: nobody has published the mounting yet.
TEST_F(OdometryNode, WaitsForTheMountingAndNamesTheCommandThatPublishesIt) {
  ASSERT_TRUE(probe_->waitForLog("base_link -> camera_left_optical"));
  EXPECT_TRUE(probe_->waitForLog("rosrun tf2_ros static_transform_publisher"));
  EXPECT_TRUE(probe_->odometry.empty()) << "identity was assumed";
  publishMounting();
  EXPECT_TRUE(waitForTracking());
  EXPECT_FALSE(probe_->odometry.empty());
}

TEST_F(OdometryNode, NamesTheSilentTopic) {
  ASSERT_TRUE(waitForTracking());
  probe_->forget();
  rig_->with_disparity = false;
  EXPECT_TRUE(probe_->waitForLog("no message on /camera/disparity"));
  rig_->with_disparity = true;
  EXPECT_TRUE(waitForTracking()) << "goes on by itself";
}

TEST_F(OdometryNode, ExplainsStampsThatNeverMatch) {
  ASSERT_TRUE(waitForTracking());
  probe_->forget();
  rig_->right_stamp_offset_s = 100.0;
  EXPECT_TRUE(probe_->waitForLog("different clocks"));
  rig_->right_stamp_offset_s = 0.0;
  EXPECT_TRUE(waitForTracking());
}

TEST_F(OdometryNode, RefusesDifferingFrameIdsAndLivesOn) {
  ASSERT_TRUE(waitForTracking());
  probe_->forget();
  rig_->right_frame_id = "camera_right_optical";
  EXPECT_TRUE(probe_->waitForLog("frame ids differ: left 'camera_left_optical', right 'camera_right_optical'",
                                 kLongWait_s));
  rig_->right_frame_id = "camera_left_optical";
  EXPECT_TRUE(waitForTracking());
}

TEST_F(OdometryNode, NoticesSwappedCameras) {
  ASSERT_TRUE(waitForTracking());
  probe_->forget();
  rig_->swapped = true;
  EXPECT_TRUE(probe_->waitForLog("left and right images are swapped"));
  rig_->swapped = false;
  EXPECT_TRUE(waitForTracking());
}

TEST_F(OdometryNode, ResetBeginsAtTheOrigin) {
  ASSERT_TRUE(waitForTracking());
  ros::NodeHandle handle;
  SetPose far;
  far.request.pose.pose.pose.position.x = 50.0;
  far.request.pose.pose.pose.orientation.w = 1.0;
  ASSERT_TRUE(handle.serviceClient<SetPose>("vo/set_pose").call(far));
  EXPECT_TRUE(far.response.success) << far.response.message;
  const auto isFar = [] {
    return !probe_->odometry.empty() && probe_->odometry.back().pose.pose.position.x > 40.0;
  };
  EXPECT_TRUE(spinUntil(isFar));

  std_srvs::Empty reset;
  ASSERT_TRUE(handle.serviceClient<std_srvs::Empty>("vo/reset").call(reset));
  EXPECT_TRUE(spinUntil([&] { return !isFar(); }));
  EXPECT_LT(std::abs(probe_->odometry.back().pose.pose.position.x), 2.0);
  EXPECT_TRUE(waitForTracking());
}

TEST_F(OdometryNode, SetPoseRefusesWhatIsNoPoseInItsFrame) {
  ros::NodeHandle handle;
  auto client = handle.serviceClient<SetPose>("vo/set_pose");
  SetPose call;
  call.request.pose.header.frame_id = "map";
  call.request.pose.pose.pose.orientation.w = 1.0;
  ASSERT_TRUE(client.call(call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(call.response.message.find("'map'"), std::string::npos);
  call.request.pose.header.frame_id = "odom";
  call.request.pose.pose.pose.orientation.w = 0.0;
  ASSERT_TRUE(client.call(call));
  EXPECT_FALSE(call.response.success);
}

TEST_F(OdometryNode, PicturesAndCloudForWhoWantsThem) {
  ASSERT_TRUE(waitForTracking());
  ros::NodeHandle handle;
  sensor_msgs::ImageConstPtr debug, disparity;
  sensor_msgs::PointCloud2ConstPtr cloud;
  const auto subscribe = [&handle](const std::string& topic, auto& slot) {
    using Pointer = std::decay_t<decltype(slot)>;
    using Message = typename Pointer::element_type;
    const boost::function<void(const Pointer&)> handler = [&slot](const Pointer& message) { slot = message; };
    return handle.subscribe<std::remove_const_t<Message>>(topic, 1, handler);
  };
  const auto debug_subscriber = subscribe("vo/debug_image", debug);
  const auto disparity_subscriber = subscribe("vo/disparity_view", disparity);
  const auto cloud_subscriber = subscribe("vo/features", cloud);
  ASSERT_TRUE(spinUntil([&] { return debug && disparity && cloud; }));
  EXPECT_EQ(debug->encoding, "bgr8");
  EXPECT_EQ(disparity->encoding, "bgr8");
  EXPECT_GT(cloud->width, 20u);
  EXPECT_EQ(cloud->header.frame_id, "camera_left_optical");
}

}  // namespace
}  // namespace stereo_nav::test
