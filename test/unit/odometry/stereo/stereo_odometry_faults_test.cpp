#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "odometry/stereo/stereo_odometry.h"
#include "room_course.h"

namespace stereo_nav::odometry {
namespace {

using StereoOdometryFaultsTest = StereoOdometryTest;

TEST_F(StereoOdometryFaultsTest, ReportsDarknessAndRecovers) {
  StereoOdometry vo = odometry();
  const FrameResult before = drive(vo, course());
  StereoFrame dark = frameAt(kPeriod_s * kFrames);
  dark.left.setTo(0);
  dark.right.setTo(0);
  double sigma_m = 0.0;
  for (int i = 0; i < 10; ++i) {
    dark.left_time_s = dark.right_time_s = kPeriod_s * (kFrames + i);
    const FrameResult result = vo.process(dark);
    EXPECT_EQ(result.state, State::kCoasting);
    EXPECT_NE(result.reason.find("dark"), std::string::npos) << result.reason;
    const Eigen::Isometry3d moved = before.T_start_camera.inverse() * result.T_start_camera;
    EXPECT_NEAR(moved.translation().norm(), 0.4 * kPeriod_s * (i + 1), 0.02 * (i + 1))
        << "0.4 m/s, as before";
    EXPECT_GT(std::sqrt(result.motion_covariance(2, 2)), sigma_m);
    sigma_m = std::sqrt(result.motion_covariance(2, 2));
  }
  dark.left_time_s = dark.right_time_s = kPeriod_s * (kFrames + 10);
  const Eigen::Matrix4d coasted = vo.process(dark).T_start_camera.matrix();
  dark.left_time_s = dark.right_time_s = kPeriod_s * (kFrames + 11);
  const FrameResult held = vo.process(dark);
  EXPECT_EQ(held.state, State::kLost);
  EXPECT_TRUE(held.T_start_camera.matrix().isApprox(coasted, 1e-9)) << "no invented motion";
  StereoFrame light = frameAt(kPeriod_s * (kFrames - 1));
  light.left_time_s = light.right_time_s = kPeriod_s * (kFrames + 12);
  vo.process(light);
  light.left_time_s = light.right_time_s = kPeriod_s * (kFrames + 13);
  EXPECT_EQ(vo.process(light).state, State::kTracking);
}

TEST_F(StereoOdometryFaultsTest, FindsItsWayAfterDarknessInWhichItMoved) {
  auto frames = course();
  for (const std::size_t i : {5u, 6u, 7u}) {
    frames[i].left.setTo(3);
    frames[i].right.setTo(3);
  }
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, frames);
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.015);
}

TEST_F(StereoOdometryFaultsTest, FollowsThroughImagesBlurredByMotion) {
  auto frames = course();
  for (const std::size_t i : {5u, 6u}) {
    cv::blur(frames[i].left, frames[i].left, {11, 11});
    cv::blur(frames[i].right, frames[i].right, {11, 11});
  }
  StereoOdometry vo = odometry();
  for (const StereoFrame& frame : frames) {
    const FrameResult result = vo.process(frame);
    EXPECT_NE(result.state, State::kLost) << result.reason;
    if (&frame == &frames.back()) {
      EXPECT_LT(endError(result), 0.02);
    }
  }
}

/// Strong texture of the given width, for something that moves on its own.
cv::Mat movingBlock(const vision::StereoCalibration& calibration, int width) {
  cv::RNG random(5);
  cv::Mat block(calibration.height, width, CV_8UC1);
  random.fill(block, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(block, block, {0, 0}, 2.0);
  cv::normalize(block, block, 0, 255, cv::NORM_MINMAX);
  return block;
}

/// Lays `block` into both images with its left edge at `x`, 1.9 m away.
void showBlock(const cv::Mat& block, int x, const vision::StereoCalibration& calibration,
               StereoFrame& frame) {
  const auto show = [&block](cv::Mat& image, int at) {
    const cv::Rect visible = cv::Rect(at, 0, block.cols, block.rows) & cv::Rect({0, 0}, image.size());
    if (visible.empty()) return;
    block(visible - cv::Point(at, 0)).copyTo(image(visible));
  };
  show(frame.left, x);
  show(frame.right, x - static_cast<int>(calibration.fx * calibration.baseline_m / 1.9));
}

TEST_F(StereoOdometryFaultsTest, IsNotCarriedAwayByWhatEntersTheView) {
  // Over two fifths of the view and sideways by 7 px per frame.
  const cv::Mat block = movingBlock(calibration, calibration.width * 2 / 5);
  auto frames = course();
  for (std::size_t i = 5; i < frames.size(); ++i) {
    showBlock(block, calibration.width - block.cols - 7 * static_cast<int>(i - 5), calibration, frames[i]);
  }
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, frames);
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.02);
}

TEST_F(StereoOdometryFaultsTest, SaysSoWhenSomethingThatMovesFillsTheView) {
  // The rig stands; something that passes before it at 4 m/s fills first half, then all of the view.
  constexpr double kFramePeriod_s = 1.0 / 30.0;
  constexpr int kSpeed_px = 20;
  const cv::Mat block = movingBlock(calibration, calibration.width);
  const StereoFrame scene = frameAt(0.0);
  StereoOdometry vo = odometry();
  int lost = 0;
  FrameResult result;
  for (int i = 0; i < 50; ++i) {
    StereoFrame frame;
    frame.left = scene.left.clone();
    frame.right = scene.right.clone();
    frame.left_time_s = frame.right_time_s = kFramePeriod_s * i;
    showBlock(block, calibration.width - kSpeed_px * (i - 4), calibration, frame);
    result = vo.process(frame);
    if (!isMeasured(result.state)) ++lost;
    // An odometry that followed this motion would be metres away.
    EXPECT_LT(result.T_start_camera.translation().norm(), 0.25) << "frame " << i;
  }
  EXPECT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_GE(lost, 5);
}

TEST_F(StereoOdometryFaultsTest, NothingIsTrackedBeforeAThirdFrameConfirmsTheFirstMotion) {
  StereoOdometry vo = odometry();
  const auto frames = course();
  EXPECT_EQ(vo.process(frames[0]).state, State::kInitialising);
  const FrameResult second = vo.process(frames[1]);
  EXPECT_EQ(second.state, State::kInitialising);
  EXPECT_NE(second.reason.find("confirms"), std::string::npos) << second.reason;
  EXPECT_EQ(vo.process(frames[2]).state, State::kTracking);
}

TEST_F(StereoOdometryFaultsTest, AFirstMotionThatTheSecondContradictsIsForgotten) {
  // The second image was taken elsewhere: the motion to it, and away from it, is 0.5 m within 0.1 s.
  StereoOdometry vo = odometry();
  vo.process(frameAt(0.0));
  StereoFrame elsewhere = frameAt(1.25);
  elsewhere.left_time_s = elsewhere.right_time_s = 0.1;
  EXPECT_NE(vo.process(elsewhere).state, State::kTracking);
  const FrameResult third = vo.process(frameAt(0.2));
  EXPECT_EQ(third.state, State::kLost);
  EXPECT_TRUE(third.new_map);
  EXPECT_TRUE(third.T_start_camera.translation().isZero()) << "a new map at the old pose";
  EXPECT_EQ(vo.process(frameAt(0.3)).state, State::kInitialising);
  const FrameResult fifth = vo.process(frameAt(0.4));
  EXPECT_EQ(fifth.state, State::kTracking) << fifth.reason;
  const Eigen::Isometry3d truth = test::roomDrive(0.2).inverse() * test::roomDrive(0.4);
  EXPECT_LT((fifth.T_start_camera.translation() - truth.translation()).norm(), 0.01);
}

TEST_F(StereoOdometryFaultsTest, AMapThatRestartsIsOnProbation) {
  StereoParams params;
  params.max_lost_frames = 0;
  StereoOdometry vo(params, calibration, Eigen::Matrix3d::Identity());
  drive(vo, course());
  // Elsewhere in the room: nothing of the old map is in view.
  const auto turned = [&](int i) {
    StereoFrame frame = frameAt(kPeriod_s * i + 5.0);
    frame.left_time_s = frame.right_time_s = kPeriod_s * (kFrames + i);
    return frame;
  };
  const FrameResult anew = vo.process(turned(0));
  EXPECT_EQ(anew.state, State::kLost) << anew.reason;
  EXPECT_TRUE(anew.new_map);
  EXPECT_EQ(vo.process(turned(1)).state, State::kInitialising);
  EXPECT_EQ(vo.process(turned(2)).state, State::kTracking);
}

TEST_F(StereoOdometryFaultsTest, ARightCameraKnockedAfterItsCalibrationIsLearned) {
  auto frames = course();
  cv::Mat knock = cv::getRotationMatrix2D(
      {static_cast<float>(calibration.cx), static_cast<float>(calibration.cy)}, 0.4, 1.0);
  knock.at<double>(1, 2) += 2.5;
  for (StereoFrame& frame : frames) {
    cv::warpAffine(frame.right.clone(), frame.right, knock, frame.right.size(), cv::INTER_CUBIC,
                   cv::BORDER_REPLICATE);
  }
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, frames);
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_GE(result.inliers, 50u);
  EXPECT_LT(endError(result), 0.015);
}

TEST_F(StereoOdometryFaultsTest, AWrongBiasOfTheRatesDoesNotTurnIt) {
  StereoOdometry vo = odometry();
  FrameResult result;
  for (int i = 0; i < kFrames; ++i) {
    for (int k = 0; k <= 10; ++k) {
      ImuSample sample;
      sample.time_s = kPeriod_s * (i - 1) + 0.01 * k;
      const Eigen::Matrix3d turn =
          (test::roomDrive(sample.time_s).inverse() * test::roomDrive(sample.time_s + 0.01)).linear();
      sample.angular_velocity = logRotation(turn) / 0.01 + Eigen::Vector3d(0.08, -0.05, 0.06);
      vo.addImu(sample);
    }
    result = vo.process(frameAt(kPeriod_s * i));
  }
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.01);
}

TEST_F(StereoOdometryFaultsTest, RefusesImpossibleStamps) {
  StereoOdometry vo = odometry();
  const auto frames = course();
  for (std::size_t i = 0; i < 5; ++i) vo.process(frames[i]);
  StereoFrame frame = frames[5];
  for (const double time_s :
       {frames[4].left_time_s, frames[2].left_time_s, std::numeric_limits<double>::quiet_NaN(),
        std::numeric_limits<double>::infinity()}) {
    frame.left_time_s = frame.right_time_s = time_s;
    EXPECT_THROW(vo.process(frame), std::invalid_argument) << time_s;
  }
  frame = frames[5];
  frame.right_time_s += 7200.0;
  EXPECT_THROW(vo.process(frame), std::invalid_argument) << "clocks of two time zones";
  for (const double readout_s : {-0.01, 30.0, std::numeric_limits<double>::quiet_NaN()}) {
    frame = frames[5];
    frame.readout_s = readout_s;
    EXPECT_THROW(vo.process(frame), std::invalid_argument)
        << readout_s << " s from the first row to the last";
  }
  FrameResult result;
  for (std::size_t i = 5; i < frames.size(); ++i) result = vo.process(frames[i]);
  EXPECT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.01) << "what was refused left no trace";
  vo.reset();
  EXPECT_NO_THROW(vo.process(frames[0]));
}

TEST_F(StereoOdometryFaultsTest, ADarkStartIsNoKeyframe) {
  StereoOdometry vo = odometry();
  StereoFrame dark = frameAt(0.0);
  dark.left.setTo(0);
  dark.right.setTo(0);
  const FrameResult result = vo.process(dark);
  EXPECT_FALSE(result.keyframe);
  EXPECT_NE(result.reason.find("dark"), std::string::npos) << result.reason;
  EXPECT_EQ(vo.process(frameAt(0.1)).state, State::kLost);
  EXPECT_EQ(vo.process(frameAt(0.2)).state, State::kInitialising);
  EXPECT_EQ(vo.process(frameAt(0.3)).state, State::kTracking);
}

TEST_F(StereoOdometryFaultsTest, RefusesImagesOfAnotherSizeOrType) {
  StereoOdometry vo = odometry();
  StereoFrame frame = frameAt(0.0);
  frame.right = cv::Mat();
  EXPECT_THROW(vo.process(frame), std::invalid_argument);
  frame = frameAt(0.0);
  frame.left = frame.left(cv::Rect(0, 0, 100, 100)).clone();
  EXPECT_THROW(vo.process(frame), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::odometry
