#include "ros/info_gate.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include "support/fixture_bag.h"
#include "support/text.h"
#include "support/textured_room.h"

namespace stereo_nav::ros_io {
namespace {

const cv::Size kRoomSize(320, 240);

sensor_msgs::CameraInfo roomInfo(bool right, double stamp_s) {
  sensor_msgs::CameraInfo info = test::cameraInfo(test::roomCalibration(), right);
  info.header.stamp = ros::Time(stamp_s);
  return info;
}

sensor_msgs::CameraInfoConstPtr message(const sensor_msgs::CameraInfo& info) {
  return boost::make_shared<sensor_msgs::CameraInfo>(info);
}

/// Both cameras' messages of one stamp; the number of messages that are passed on.
std::size_t addPair(InfoGate& gate, const sensor_msgs::CameraInfo& left,
                    const sensor_msgs::CameraInfo& right) {
  const std::size_t first = gate.addInfo(InfoGate::kLeft, message(left)).size();
  return first + gate.addInfo(InfoGate::kRight, message(right)).size();
}

std::size_t addImage(InfoGate& gate, InfoGate::Side side, const cv::Size& size, double stamp_s = 0.5) {
  std_msgs::Header header;
  header.stamp = ros::Time(stamp_s);
  return gate.addImage(side, header, size, stamp_s).size();
}

std::size_t addSizes(InfoGate& gate, const cv::Size& size, double stamp_s = 0.5) {
  return addImage(gate, InfoGate::kLeft, size, stamp_s) + addImage(gate, InfoGate::kRight, size, stamp_s);
}

TEST(InfoGate, NothingOfAGoodPairIsLost) {
  InfoGate gate;
  EXPECT_EQ(addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0)), 0u) << "the image sizes are unknown";
  EXPECT_EQ(addPair(gate, roomInfo(false, 2.0), roomInfo(true, 2.0)), 0u);
  EXPECT_EQ(addImage(gate, InfoGate::kLeft, kRoomSize), 0u);
  const auto passed = gate.addImage(InfoGate::kRight, std_msgs::Header(), kRoomSize, 0.5);
  ASSERT_EQ(passed.size(), 4u);
  EXPECT_EQ(passed[0].info->header.stamp, ros::Time(1.0));
  EXPECT_EQ(passed[3].side, InfoGate::kRight);
  EXPECT_EQ(passed[3].info->header.stamp, ros::Time(2.0));
  EXPECT_LT(passed[3].info->P[3], 0.0);
  EXPECT_EQ(addPair(gate, roomInfo(false, 3.0), roomInfo(true, 3.0)), 2u);
  EXPECT_TRUE(gate.problem().empty());
}

TEST(InfoGate, KeepsARefusedPairBackUntilItIsGood) {
  InfoGate gate;
  sensor_msgs::CameraInfo zero;
  zero.header = roomInfo(false, 1.0).header;
  EXPECT_EQ(addPair(gate, zero, zero), 0u);
  EXPECT_TRUE(contains(gate.problem(), "not calibrated")) << gate.problem();
  auto bad = roomInfo(true, 2.0);
  bad.R[0] = 2.0;
  EXPECT_EQ(addPair(gate, roomInfo(false, 2.0), bad), 0u);
  EXPECT_TRUE(contains(gate.problem(), "R is no rotation")) << gate.problem();
  addSizes(gate, kRoomSize);
  EXPECT_EQ(addPair(gate, roomInfo(false, 3.0), roomInfo(true, 3.0)), 0u);
  addSizes(gate, kRoomSize);
  EXPECT_EQ(addPair(gate, roomInfo(false, 4.0), roomInfo(true, 4.0)), 2u);
  EXPECT_TRUE(gate.problem().empty()) << gate.problem();
}

TEST(InfoGate, ImagesMustHaveTheSizeOfTheCalibration) {
  InfoGate gate;
  addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0));
  addSizes(gate, cv::Size(640, 480));
  EXPECT_TRUE(contains(gate.problem(), "raw image is 640x480, its camera_info is for 320x240"))
      << gate.problem();
  addSizes(gate, kRoomSize);
  EXPECT_TRUE(gate.problem().empty()) << gate.problem();
}

TEST(InfoGate, BothCalibrationsMayChangeWhileItRuns) {
  InfoGate gate;
  addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0));
  addSizes(gate, kRoomSize);
  auto left = roomInfo(false, 2.0), right = roomInfo(true, 2.0);
  left.P[0] = left.P[5] = right.P[0] = right.P[5] = 300.0;
  EXPECT_EQ(addPair(gate, left, right), 0u);
  EXPECT_TRUE(gate.problem().empty()) << "the new left one is not compared with the old right one";
  addSizes(gate, kRoomSize);
  left.header.stamp = right.header.stamp = ros::Time(3.0);
  const auto passed = gate.addInfo(InfoGate::kLeft, message(left));
  ASSERT_FALSE(passed.empty());
  EXPECT_EQ(passed.back().info->P[0], 300.0);
  EXPECT_EQ(gate.notes().size(), 2u) << "K and P differ, D is 0";
  EXPECT_EQ(passed.back().info->D[0], 1e-9);
}

TEST(InfoGate, ImagesAreOnlyAskedForUntilEachIsSeenToHaveItsInfo) {
  InfoGate gate;
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(gate.needsImages(InfoGate::kLeft)) << i;
    EXPECT_EQ(addPair(gate, roomInfo(false, 1.0 + i), roomInfo(true, 1.0 + i)), i == 0 ? 0u : 2u);
    EXPECT_EQ(addSizes(gate, kRoomSize, 1.0 + i), i == 0 ? 2u : 0u);
  }
  EXPECT_FALSE(gate.needsImages(InfoGate::kLeft));
  EXPECT_FALSE(gate.needsImages(InfoGate::kRight));
  EXPECT_TRUE(gate.notes().empty());
}

TEST(InfoGate, WithFewInfosEachImageGetsTheLatest) {
  InfoGate gate;
  addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0));
  std::size_t passed = 0;
  for (int i = 0; i < 40; ++i) {
    const double now_s = 1.0 + 0.1 * i;
    passed += addSizes(gate, kRoomSize, now_s);
    EXPECT_EQ(gate.passOnOverdue(now_s + 0.05).size(), 0u) << "its own may come yet";
    passed += gate.passOnOverdue(now_s + 0.11).size();
  }
  EXPECT_EQ(passed, 2u * 40);
  EXPECT_TRUE(gate.needsImages(InfoGate::kRight));
  EXPECT_EQ(addPair(gate, roomInfo(false, 5.0), roomInfo(true, 5.0)), 0u) << "image 5.0 will have it";
  std_msgs::Header header;
  header.stamp = ros::Time(5.0);
  const auto last = gate.addImage(InfoGate::kLeft, header, kRoomSize, 5.0);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].info->header.stamp, header.stamp);
  EXPECT_TRUE(contains(gate.notes().back(), "right camera_info comes more seldom than the images"));
}

TEST(InfoGate, ImagesThatChangeTheirSizeAreNoticed) {
  InfoGate gate;
  addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0));
  for (int i = 0; i < 15; ++i) addSizes(gate, kRoomSize, 1.0 + 0.1 * i);
  EXPECT_TRUE(gate.problem().empty()) << gate.problem();
  EXPECT_EQ(addSizes(gate, cv::Size(640, 480), 3.0), 0u);
  EXPECT_TRUE(contains(gate.problem(), "raw image is 640x480")) << gate.problem();
}

}  // namespace
}  // namespace stereo_nav::ros_io
