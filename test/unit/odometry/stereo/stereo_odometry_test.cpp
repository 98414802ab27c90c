#include "odometry/stereo/stereo_odometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "room_course.h"

namespace stereo_nav::odometry {
namespace {

TEST_F(StereoOdometryTest, FollowsADrive) {
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, course());
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.01);  // of 0.44 m
  EXPECT_GE(result.inliers, 50u);
  EXPECT_LT(result.reprojection_error_px, 0.5);
  const double sigma_m = std::sqrt(result.pose_noise.topLeftCorner<3, 3>().trace());
  EXPECT_GT(sigma_m, 1e-5);
  EXPECT_LT(sigma_m, 0.02);
}

TEST_F(StereoOdometryTest, FollowsADriveWithARightCameraThatIsHalfAFrameLate) {
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, course(0.05));
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_TRUE(result.time_offset_compensated);
  EXPECT_LT(endError(result), 0.015);
}

TEST_F(StereoOdometryTest, FollowsADriveWithARightCameraThatIsEarly) {
  StereoOdometry vo = odometry();
  const FrameResult result = drive(vo, course(-0.04));
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result), 0.015);
}

/// Errors in m at the end of a drive with a rolling shutter, when the odometry knows of it and when not.
struct RollingErrors {
  double aware_m;
  double unaware_m;
};

class RollingOdometryTest : public StereoOdometryTest {
 protected:
  template <typename Seconds>
  RollingErrors errors(const Seconds& seconds) const {
    constexpr int kRollingFrames = 7;
    std::vector<StereoFrame> frames;
    for (int i = 0; i < kRollingFrames; ++i) frames.push_back(rollingFrameAt(kPeriod_s * i, 0.06, seconds));
    const double end_s = seconds(frames.back().left_time_s) - seconds(0.0);
    StereoOdometry aware = odometry();
    const FrameResult known = drive(aware, frames);
    for (StereoFrame& frame : frames) frame.readout_s = 0.0;
    StereoOdometry unaware = odometry();
    return {endError(known, end_s), endError(drive(unaware, frames), end_s)};
  }
};

TEST_F(RollingOdometryTest, KnowsWhenTheRowsOfAnAcceleratingDriveWereTaken) {
  // From rest to twice the speed of roomDrive().
  const RollingErrors errors =
      this->errors([](double time_s) { return time_s < 0.0 ? 0.0 : time_s * time_s / 0.6; });
  EXPECT_LT(errors.aware_m, 0.005);  // of 0.24 m
  EXPECT_GT(errors.unaware_m, 3.0 * errors.aware_m);
}

TEST_F(RollingOdometryTest, StartsInTheMidstOfADrive) {
  const RollingErrors errors = this->errors([](double time_s) { return time_s + 1.0; });
  EXPECT_LT(errors.aware_m, 0.005);
}

TEST_F(RollingOdometryTest, ACoveredSecondImageDoesNotBendTheStart) {
  constexpr double kReadout_s = 0.06;
  const auto seconds = [](double time_s) { return time_s; };
  StereoOdometry vo = odometry();
  vo.process(rollingFrameAt(0.0, kReadout_s, seconds));
  StereoFrame covered = rollingFrameAt(0.1, kReadout_s, seconds);
  covered.left.setTo(90);
  EXPECT_EQ(vo.process(covered).state, State::kLost);
  FrameResult result;
  for (const double time_s : {0.2, 0.3, 0.4})
    result = vo.process(rollingFrameAt(time_s, kReadout_s, seconds));
  ASSERT_EQ(result.state, State::kTracking) << result.reason;
  EXPECT_LT(endError(result, 0.4), 0.005);
}

TEST_F(StereoOdometryTest, StandsStillWithoutDrift) {
  StereoOdometry vo = odometry();
  drive(vo, course());
  const StereoFrame last = frameAt(kPeriod_s * (kFrames - 1));
  FrameResult first;
  FrameResult result;
  for (int i = 0; i < 30; ++i) {
    StereoFrame frame = last;
    frame.left_time_s = frame.right_time_s = kPeriod_s * (kFrames + i);
    result = vo.process(frame);
    ASSERT_EQ(result.state, State::kTracking) << result.reason;
    if (i == 0) first = result;
  }
  const Eigen::Isometry3d drift = first.T_start_camera.inverse() * result.T_start_camera;
  EXPECT_LT(drift.translation().norm(), 1e-3);
  EXPECT_LT(Eigen::AngleAxisd(drift.linear()).angle(), 1e-3);
}

/// Median distance in px of the inliers from the keyframe in the next frame, if they continue to move.
double parallaxAhead(const FrameResult& result, const std::map<std::uint64_t, cv::Point2f>& keyframe) {
  std::vector<double> parallax;
  for (const FeatureReport& feature : result.features) {
    if (feature.fate != FeatureReport::Fate::kInlier) continue;
    parallax.push_back(cv::norm(feature.current_px - keyframe.at(feature.id)) +
                       cv::norm(feature.current_px - feature.previous_px));
  }
  std::sort(parallax.begin(), parallax.end());
  return parallax.at(parallax.size() / 2);
}

TEST_F(StereoOdometryTest, MakesAKeyframeBeforeFeaturesHaveMovedTooFar) {
  StereoParams params;
  params.keyframes.min_tracked_share = 0.0;
  params.keyframes.max_parallax_px = 8.0;
  // The next keyframe comes late in slow motion and at once in fast motion.
  for (const auto& [period_s, frames, fewest, most] :
       {std::tuple{0.02, 30, 5, 10}, std::tuple{0.05, 10, 2, 4}, std::tuple{0.2, 4, 1, 1}}) {
    StereoOdometry vo(params, calibration, Eigen::Matrix3d::Identity());
    std::map<std::uint64_t, cv::Point2f> keyframe;
    int since = 0;
    for (int i = 0; i < frames; ++i) {
      const FrameResult result = vo.process(frameAt(period_s * i));
      ++since;
      if (i > 0) {
        ASSERT_TRUE(isMeasured(result.state)) << result.reason;
        EXPECT_EQ(result.keyframe, parallaxAhead(result, keyframe) > 8.0) << i << " of " << period_s;
        EXPECT_LE(since, most) << i << " of " << period_s;
      }
      if (!result.keyframe) continue;
      if (i > 0) {
        EXPECT_GE(since, fewest) << i << " of " << period_s;
      }
      since = 0;
      keyframe.clear();
      for (const FeatureReport& feature : result.features) keyframe[feature.id] = feature.current_px;
    }
  }
}

TEST_F(StereoOdometryTest, MakesAKeyframeWhenFewOfItsFeaturesAreLeft) {
  StereoParams params;
  params.keyframes.max_parallax_px = 1000.0;
  for (const double share : {0.0, 1.0}) {
    params.keyframes.min_tracked_share = share;
    StereoOdometry vo(params, calibration, Eigen::Matrix3d::Identity());
    int keyframes = 0;
    for (const StereoFrame& frame : course()) {
      if (vo.process(frame).keyframe) ++keyframes;
    }
    EXPECT_EQ(keyframes > 1, share > 0.5) << share;
  }
}

TEST_F(StereoOdometryTest, EqualInputGivesEqualOutput) {
  StereoOdometry one = odometry();
  StereoOdometry other = odometry();
  const auto frames = course();
  const FrameResult result = drive(one, frames);
  drive(other, frames);
  other.reset();
  EXPECT_EQ(drive(other, frames).T_start_camera.matrix(), result.T_start_camera.matrix());
}

void expectEqual(const FrameResult& one, const FrameResult& other, std::size_t frame) {
  SCOPED_TRACE(frame);
  EXPECT_EQ(one.state, other.state);
  EXPECT_EQ(one.reason, other.reason);
  EXPECT_EQ(one.T_start_camera.matrix(), other.T_start_camera.matrix());
  EXPECT_EQ(one.T_previous_current.matrix(), other.T_previous_current.matrix());
  EXPECT_EQ(one.motion_covariance, other.motion_covariance);
  EXPECT_EQ(one.pose_noise, other.pose_noise);
  EXPECT_EQ(one.keyframe, other.keyframe);
  EXPECT_EQ(one.keyframe_id, other.keyframe_id);
  EXPECT_EQ(one.features_detected, other.features_detected);
  EXPECT_EQ(one.inliers, other.inliers);
  ASSERT_EQ(one.features.size(), other.features.size());
  for (std::size_t i = 0; i < one.features.size(); ++i) {
    EXPECT_EQ(one.features[i].id, other.features[i].id);
    EXPECT_EQ(one.features[i].current_px, other.features[i].current_px);
    EXPECT_EQ(one.features[i].p_camera, other.features[i].p_camera);
  }
}

TEST_F(StereoOdometryTest, AfterAResetARunEqualsAFirstRunToTheLastBit) {
  StereoOdometry first = odometry();
  StereoOdometry other = odometry();
  // reset() must forget the following: a drive with a late right camera, an IMU and darkness; then two images
  // of a rolling shutter, the second of which is covered, so that the start waits for its compensation.
  for (int i = 0; i < 200; ++i) {
    ImuSample sample;
    sample.time_s = 0.01 * i;
    sample.angular_velocity = Eigen::Vector3d(0.01, 0.2, 0.0);
    other.addImu(sample);
  }
  auto forgotten = course(0.05);
  for (const std::size_t i : {9u, 10u, 11u}) forgotten[i].left.setTo(3);
  drive(other, forgotten);
  other.reset();
  StereoFrame rolling = frameAt(0.0);
  rolling.readout_s = 0.05;
  other.process(rolling);
  rolling.left_time_s = rolling.right_time_s = 0.1;
  rolling.left.setTo(3);
  other.process(rolling);
  other.reset();
  const auto frames = course(0.03);
  for (std::size_t i = 0; i < frames.size(); ++i)
    expectEqual(first.process(frames[i]), other.process(frames[i]), i);
}

TEST_F(StereoOdometryTest, GivesTheSameOnAnyNumberOfThreads) {
  const int threads_before = cv::getNumThreads();
  const auto frames = course(0.02);
  cv::setNumThreads(1);
  StereoOdometry alone = odometry();
  const FrameResult result = drive(alone, frames);
  for (const int threads : {2, 4}) {
    cv::setNumThreads(threads);
    StereoOdometry many = odometry();
    EXPECT_EQ(drive(many, frames).T_start_camera.matrix(), result.T_start_camera.matrix()) << threads;
  }
  cv::setNumThreads(threads_before);
}

TEST_F(StereoOdometryTest, WorksWithAnyNumberOfPyramidLevels) {
  const auto frames = course();
  for (const int levels : {1, 2, 8}) {
    StereoParams params;
    params.pyramid_levels = levels;
    StereoOdometry vo(params, calibration, Eigen::Matrix3d::Identity());
    const FrameResult result = drive(vo, frames);
    ASSERT_EQ(result.state, State::kTracking) << levels << ": " << result.reason;
    EXPECT_LT(endError(result), 0.02) << levels;
  }
}

}  // namespace
}  // namespace stereo_nav::odometry
