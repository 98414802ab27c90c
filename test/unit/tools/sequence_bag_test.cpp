#include "tools/import_sequence/sequence_bag.h"

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "import_test_support.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::tools {
namespace {

using sensor_msgs::CameraInfo;
using sensor_msgs::Image;

class SequenceBag : public ::testing::Test {
 protected:
  SequenceBag() { writeEuroc(folder_); }

  /// Imports the folder and returns the bag's path.
  std::string importEuroc(const BagOptions& options, const std::string& name = "out.bag") {
    Sequence sequence = readEuroc(folder_.path());
    summary_ = writeBag(sequence, options, folder_ / name, [](std::size_t, std::size_t) {});
    return folder_ / name;
  }

  TemporaryFolder folder_;
  BagSummary summary_;
};

BagOptions atImu() {
  BagOptions options;
  options.base_frame = BaseFrame::kImu;
  return options;
}

TEST_F(SequenceBag, holdsEverythingAtItsOwnStamp) {
  const auto bag = importEuroc(atImu());
  EXPECT_EQ(summary_.pairs, 6u);
  EXPECT_EQ(summary_.left_without_partner, 0u);
  const auto left = readTopic<Image>(bag, "camera/left/image_raw");
  const auto right = readTopic<Image>(bag, "camera/right/image_raw");
  ASSERT_EQ(left.size(), 6u);
  ASSERT_EQ(right.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto stamp =
        static_cast<std::uint64_t>(kEurocStart_ns + static_cast<long long>(i) * kEurocPeriod_ns);
    EXPECT_EQ(left[i].header.stamp.toNSec(), stamp);
    EXPECT_EQ(right[i].header.stamp.toNSec(), stamp);
    EXPECT_EQ(left[i].header.frame_id, "camera_left_optical");
    EXPECT_EQ(right[i].header.frame_id, "camera_left_optical");
    EXPECT_EQ(left[i].encoding, "mono8");
    EXPECT_EQ(indexOf(left[i].data), static_cast<int>(i));
  }
  EXPECT_EQ(readTopic<CameraInfo>(bag, "camera/left/camera_info").size(), 6u);
  EXPECT_EQ(readTopic<CameraInfo>(bag, "camera/right/camera_info")[5].header.frame_id, "camera_left_optical");
  const auto imu = readTopic<sensor_msgs::Imu>(bag, "imu/data");
  ASSERT_EQ(imu.size(), 5u);
  EXPECT_EQ(imu[0].orientation_covariance[0], -1.0);
  EXPECT_EQ(imu[0].angular_velocity.z, 0.3);
  EXPECT_EQ(imu[0].header.frame_id, "imu_link");
}

TEST_F(SequenceBag, isRecordedInOrderOfTime) {
  rosbag::Bag bag(importEuroc(atImu()), rosbag::bagmode::Read);
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& message : view) {
    if (const auto image = message.instantiate<Image>()) {
      EXPECT_EQ(message.getTime(), image->header.stamp);
    }
  }
  rosbag::View transforms(bag, rosbag::TopicQuery("tf_static"));
  EXPECT_EQ(transforms.getBeginTime(), view.getBeginTime());
}

TEST_F(SequenceBag, everySecondPairWithTheRightOneFrameLate) {
  BagOptions options = atImu();
  options.every = 2;
  options.right_lag_frames = 1;
  const auto bag = importEuroc(options);
  const auto left = readTopic<Image>(bag, "camera/left/image_raw");
  const auto right = readTopic<Image>(bag, "camera/right/image_raw");
  const auto sync = readTopic<StereoSync>(bag, "camera/sync");
  ASSERT_EQ(left.size(), 3u);
  ASSERT_EQ(right.size(), 3u);
  ASSERT_EQ(sync.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(indexOf(left[i].data), static_cast<int>(2 * i));
    EXPECT_EQ(indexOf(right[i].data), static_cast<int>(2 * i + 1));
    EXPECT_EQ((right[i].header.stamp - left[i].header.stamp).toNSec(), kEurocPeriod_ns);
    EXPECT_EQ(sync[i].header.stamp, left[i].header.stamp);
    EXPECT_EQ(sync[i].left_stamp, left[i].header.stamp);
    EXPECT_EQ(sync[i].right_stamp, right[i].header.stamp);
    EXPECT_DOUBLE_EQ(sync[i].skew_s, 0.05);
    EXPECT_EQ(sync[i].right_sequence, 2 * i + 1);
    EXPECT_TRUE(std::isnan(sync[i].left_exposure_s));
  }
}

TEST_F(SequenceBag, leftImagesWithoutALaterRightOneAreCounted) {
  BagOptions options = atImu();
  options.right_lag_frames = 4;
  importEuroc(options);
  EXPECT_EQ(summary_.pairs, 2u);
  EXPECT_EQ(summary_.left_without_partner, 4u);
  options.right_lag_frames = 6;
  EXPECT_NE(messageOf<InputError>([&] { importEuroc(options, "none.bag"); }).find("no left image of 6"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.bag"));
}

TEST_F(SequenceBag, liesAboutTheRightStamps) {
  BagOptions options = atImu();
  options.right_stamp_offset_s = -0.012;
  const auto bag = importEuroc(options);
  const auto left = readTopic<Image>(bag, "camera/left/image_raw");
  const auto right = readTopic<Image>(bag, "camera/right/image_raw");
  const auto info = readTopic<CameraInfo>(bag, "camera/right/camera_info");
  const auto sync = readTopic<StereoSync>(bag, "camera/sync");
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(indexOf(right[i].data), static_cast<int>(i));
    EXPECT_EQ((right[i].header.stamp - left[i].header.stamp).toNSec(), -12000000);
    EXPECT_EQ(info[i].header.stamp, right[i].header.stamp);
    EXPECT_EQ(sync[i].right_stamp, right[i].header.stamp);
    EXPECT_NEAR(sync[i].skew_s, -0.012, 1e-12);
  }
}

TEST_F(SequenceBag, baseAtTheImu) {
  const auto bag = importEuroc(atImu());
  const auto tf = readTopic<tf2_msgs::TFMessage>(bag, "tf_static");
  ASSERT_EQ(tf.size(), 1u);
  ASSERT_EQ(tf[0].transforms.size(), 2u);
  EXPECT_EQ(tf[0].transforms[0].child_frame_id, "camera_left_optical");
  const Eigen::Isometry3d T_base_camera = tf2::transformToEigen(tf[0].transforms[0]);
  EXPECT_TRUE(T_base_camera.isApprox(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 2)), 1e-9));
  EXPECT_EQ(tf[0].transforms[1].child_frame_id, "imu_link");
  EXPECT_TRUE(tf2::transformToEigen(tf[0].transforms[1]).isApprox(Eigen::Isometry3d::Identity(), 1e-9));
  const auto truth = readTopic<nav_msgs::Odometry>(bag, "ground_truth/odom");
  ASSERT_EQ(truth.size(), 3u);
  EXPECT_EQ(truth[2].child_frame_id, "base_link");
  EXPECT_NEAR(truth[2].pose.pose.position.x, 5.0, 1e-9);
  EXPECT_NEAR(truth[2].pose.pose.position.z, 2.0, 1e-9);
}

TEST_F(SequenceBag, baseAtTheCameraLooksAlongX) {
  BagOptions options;
  options.base_frame = BaseFrame::kCamera;
  const auto bag = importEuroc(options);
  const auto transforms = readTopic<tf2_msgs::TFMessage>(bag, "tf_static")[0].transforms;
  const Eigen::Isometry3d T_base_camera = tf2::transformToEigen(transforms[0]);
  EXPECT_TRUE((T_base_camera * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE((T_base_camera * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0)));
  // The IMU sits 2 m behind the camera.
  EXPECT_TRUE(tf2::transformToEigen(transforms[1]).translation().isApprox(Eigen::Vector3d(-2, 0, 0), 1e-9));
  const auto truth = readTopic<nav_msgs::Odometry>(bag, "ground_truth/odom");
  EXPECT_NEAR(truth[0].pose.pose.position.z, 2.0, 1e-9);
}

TEST_F(SequenceBag, withoutImu) {
  BagOptions options = atImu();
  options.imu = false;
  const auto bag = importEuroc(options);
  EXPECT_TRUE(readTopic<sensor_msgs::Imu>(bag, "imu/data").empty());
  EXPECT_EQ(readTopic<tf2_msgs::TFMessage>(bag, "tf_static")[0].transforms.size(), 1u);
}

TEST_F(SequenceBag, sameInputSameBytes) {
  importEuroc(atImu(), "one.bag");
  importEuroc(atImu(), "two.bag");
  EXPECT_EQ(folder_.read("one.bag"), folder_.read("two.bag"));
}

TEST_F(SequenceBag, anImageOfAnotherSizeLeavesNoBag) {
  writeImage(folder_, "cam1/data/" + std::to_string(kEurocStart_ns + 2 * kEurocPeriod_ns) + ".png",
             frameOf(2, kWidth + 2));
  EXPECT_NE(messageOf<InputError>([&] {
              importEuroc(atImu());
            }).find("frame 2 of camera/right/image_raw is 66x48, the calibration 64x48"),
            std::string::npos);
  EXPECT_EQ(folder_.countFiles(), 4u) << "only the layout's own folders may remain";
}

TEST(KittiBag, theWorldIsTheFirstBasePose) {
  const TemporaryFolder folder;
  writeKitti(folder);
  Sequence sequence = readKitti(folder.path());
  writeBag(sequence, {}, folder / "out.bag", [](std::size_t, std::size_t) {});
  const auto truth = readTopic<nav_msgs::Odometry>(folder / "out.bag", "ground_truth/odom");
  ASSERT_EQ(truth.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(truth[i].pose.pose.position.x, static_cast<double>(i), 1e-9);
    EXPECT_NEAR(truth[i].pose.pose.position.y, 0.0, 1e-9);
    EXPECT_NEAR(std::abs(truth[i].pose.pose.orientation.w), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace stereo_nav::tools
