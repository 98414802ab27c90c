#include "vision/disparity_lifter.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/textured_room.h"

namespace stereo_nav::vision {
namespace {

class DisparityLifterTest : public ::testing::Test {
 protected:
  DisparityLifterTest() : map(240, 320, CV_32FC1, cv::Scalar(-1.0F)) {}

  cv::Mat map;
  DisparityLifter lifter{{}, test::roomCalibration()};
};

TEST_F(DisparityLifterTest, DepthIsFocalLengthTimesBaselineOverDisparity) {
  map.at<float>(100, 200) = 16.8F;
  const auto lifted = lifter.lift(map, {200.2F, 99.8F});
  ASSERT_TRUE(lifted);
  EXPECT_NEAR(lifted->p_camera.z(), 280.0 * 0.12 / 16.8, 1e-6);  // 2 m
  EXPECT_NEAR(lifted->p_camera.x(), (200.2 - 159.5) / 280.0 * 2.0, 1e-5);
  EXPECT_NEAR(lifted->p_camera.y(), (99.8 - 119.5) / 280.0 * 2.0, 1e-5);
}

TEST_F(DisparityLifterTest, TheMarkerOfNoDisparityIsNeverLifted) {
  // Lifted unchecked, -1 is a block at -f * B: the -56 m of the thesis' table 4-3.
  for (const float marker : {-1.0F, 0.0F, -16.0F, std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity()}) {
    map.at<float>(100, 200) = marker;
    EXPECT_FALSE(lifter.lift(map, {200.0F, 100.0F})) << marker;
  }
}

TEST_F(DisparityLifterTest, NothingOutsideTheMap) {
  map.setTo(10.0F);
  EXPECT_TRUE(lifter.lift(map, {319.4F, 239.4F}));
  EXPECT_FALSE(lifter.lift(map, {319.6F, 100.0F}));
  EXPECT_FALSE(lifter.lift(map, {-0.6F, 100.0F}));
  EXPECT_FALSE(lifter.lift(map, {100.0F, 240.0F}));
}

TEST_F(DisparityLifterTest, DisparitiesBelowTheMinimumCountAsNone) {
  map.setTo(0.4F);
  EXPECT_FALSE(lifter.lift(map, {100.0F, 100.0F}));
}

}  // namespace
}  // namespace stereo_nav::vision
