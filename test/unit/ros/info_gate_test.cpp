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

void addSizes(InfoGate& gate, const cv::Size& size) {
  gate.addImageSize(InfoGate::kLeft, size);
  gate.addImageSize(InfoGate::kRight, size);
}

TEST(InfoGate, NothingOfAGoodPairIsLost) {
  InfoGate gate;
  EXPECT_EQ(addPair(gate, roomInfo(false, 1.0), roomInfo(true, 1.0)), 0u) << "the image sizes are unknown";
  EXPECT_EQ(addPair(gate, roomInfo(false, 2.0), roomInfo(true, 2.0)), 0u);
  EXPECT_TRUE(gate.addImageSize(InfoGate::kLeft, kRoomSize).empty());
  const auto passed = gate.addImageSize(InfoGate::kRight, kRoomSize);
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

}  // namespace
}  // namespace stereo_nav::ros_io
