#include "vision/camera_order.h"

#include <gtest/gtest.h>

#include "support/textured_room.h"

namespace stereo_nav::vision {
namespace {

using Verdict = CameraOrderCheck::Verdict;

TEST(CameraOrder, KnowsTheRightOrderFromTheSwappedOne) {
  const StereoCalibration calibration = test::roomCalibration();
  CameraOrderCheck in_order(calibration);
  CameraOrderCheck swapped(calibration);
  EXPECT_EQ(in_order.verdict(), Verdict::kUnknown);
  for (int second = 0; second < 3; ++second) {
    const auto pose = test::roomDrive(second);
    const auto pair = test::TexturedRoom().renderPair(pose, pose, calibration);
    in_order.observe(pair.left, pair.right);
    swapped.observe(pair.right, pair.left);
  }
  EXPECT_EQ(in_order.verdict(), Verdict::kInOrder);
  EXPECT_EQ(swapped.verdict(), Verdict::kSwapped);
  swapped.reset();
  EXPECT_EQ(swapped.verdict(), Verdict::kUnknown);
}

TEST(CameraOrder, AShiftedPrincipalPointIsNoDisparity) {
  // Everything lies 40 px further right in the right image, which its principal point says.
  StereoCalibration calibration = test::roomCalibration();
  calibration.right_cx += 40.0;
  CameraOrderCheck check(calibration);
  for (int second = 0; second < 3; ++second) {
    const auto pose = test::roomDrive(second);
    const auto pair = test::TexturedRoom().renderPair(pose, pose, calibration);
    check.observe(pair.left, pair.right);
  }
  EXPECT_EQ(check.verdict(), Verdict::kInOrder);
}

TEST(CameraOrder, SaysNothingWithoutTexture) {
  const StereoCalibration calibration = test::roomCalibration();
  CameraOrderCheck check(calibration);
  const cv::Mat grey(calibration.height, calibration.width, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 10; ++i) check.observe(grey, grey);
  EXPECT_EQ(check.verdict(), Verdict::kUnknown);
}

}  // namespace
}  // namespace stereo_nav::vision
