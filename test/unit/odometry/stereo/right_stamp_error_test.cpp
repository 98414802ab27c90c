// Rows of the right image that a late stamp, an unlevelled camera and noise displace.
#include "odometry/stereo/right_stamp_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "room_course.h"

namespace stereo_nav::odometry {
namespace {

/// Has seen so many frames of 150 matches, of a rig whose features flow through the rows at up to
/// `flow_px_s`.
RightStampError afterFrames(int frames, double error_s, double flow_px_s, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.4, 0.4);
  std::normal_distribution<double> noise(0.0, 0.3);
  RightStampError stamps;
  for (int i = 0; i < 150 * frames; ++i) {
    const double x = place(random), y = place(random), inverse_depth = 0.2 + std::abs(place(random));
    const double px_per_s = flow_px_s * (x * y + y * inverse_depth);
    const double rows_px = 0.8 - 1.5 * x + 0.7 * y;
    const double left_s = error_s - stamps.takenOff_s();
    stamps.add({1.0, x, y}, rows_px + left_s * px_per_s + noise(random), px_per_s);
    if (i % 150 == 149) stamps.learn();
  }
  return stamps;
}

TEST(RightStampErrorTest, TellsALateStampFromACameraThatIsNotLevel) {
  for (const double error_s : {0.02, -0.01, 0.1}) {
    const RightStampError stamps = afterFrames(60, error_s, 300.0, 1);
    EXPECT_NE(stamps.takenOff_s(), 0.0);
    const auto estimate = stamps.estimate();
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->error_s, error_s, 3.0 * estimate->sigma_s);
    EXPECT_NEAR(estimate->error_s, error_s, 1e-3 + 0.1 * std::abs(error_s));
  }
}

TEST(RightStampErrorTest, IsNotCertainOfAnErrorThatIsNotThere) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const RightStampError stamps = afterFrames(60, 0.0, 300.0, seed);
    EXPECT_EQ(stamps.takenOff_s(), 0.0);
    EXPECT_LT(std::abs(stamps.estimate()->error_s), 3.0 * stamps.estimate()->sigma_s);
  }
}

TEST(RightStampErrorTest, ARigThatStandsTellsNothing) {
  EXPECT_FALSE(RightStampError().estimate().has_value());
  EXPECT_EQ(afterFrames(60, 0.02, 0.1, 1).takenOff_s(), 0.0) << "too little moves";
}

using RightStampsTest = StereoOdometryTest;

/// The right stamps say 20 ms more than the truth.
TEST_F(RightStampsTest, AConstantErrorIsFoundAndTakenOff) {
  constexpr double kError_s = 0.02;
  StereoOdometry vo = odometry();
  FrameResult result;
  for (int i = 0; i < 40; ++i) {
    StereoFrame frame = frameAt(kPeriod_s * i);
    frame.right_time_s += kError_s;
    result = vo.process(frame);
  }
  EXPECT_TRUE(result.right_stamps_are_corrected);
  EXPECT_NEAR(result.right_stamp_error_s, kError_s, 3.0 * result.right_stamp_sigma_s);
  EXPECT_LT(result.right_stamp_sigma_s, 6e-3) << "a course of four seconds";
}

TEST_F(RightStampsTest, RightOnesAreLeftAlone) {
  for (const double offset_s : {0.0, 0.03}) {
    StereoOdometry vo = odometry();
    for (int i = 0; i < 20; ++i) {
      const FrameResult result = vo.process(frameAt(kPeriod_s * i, offset_s));
      EXPECT_FALSE(result.right_stamps_are_corrected) << offset_s << " " << result.right_stamp_error_s;
    }
  }
}

}  // namespace
}  // namespace stereo_nav::odometry
