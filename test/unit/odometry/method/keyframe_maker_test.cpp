#include "odometry/method/keyframe_maker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stereo_nav/odometry/method/odometry_config.h"
#include "support/textured_room.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kPeriod_s = 0.1;

StereoFrame roomFrameAt(double time_s) {
  const auto pair = test::TexturedRoom().renderPair(test::roomDrive(time_s), test::roomDrive(time_s),
                                                    test::roomCalibration());
  StereoFrame frame;
  frame.left_time_s = frame.right_time_s = time_s;
  frame.left = pair.left;
  frame.right = pair.right;
  return frame;
}

/// Frames of the drive through the room, rendered once.
const std::vector<StereoFrame>& roomFrames() {
  static const std::vector<StereoFrame> frames = [] {
    std::vector<StereoFrame> rendered;
    for (int i = 0; i < 11; ++i) rendered.push_back(roomFrameAt(kPeriod_s * i));
    return rendered;
  }();
  return frames;
}

std::unique_ptr<Odometry> defaultOdometry() {
  return makeOdometry(OdometryConfig(), test::roomCalibration(), Eigen::Matrix3d::Identity());
}

TEST(KeyframeMakerTest, MotionsAndDepthsAreThoseOfTheDrive) {
  const auto odometry = defaultOdometry();
  KeyframeMaker maker;
  double previous_s = 0.0;
  int keyframes = 0;
  for (const StereoFrame& frame : roomFrames()) {
    const auto keyframe = maker.add(frame, odometry->process(frame));
    if (!keyframe) continue;
    EXPECT_EQ(keyframe->follows, keyframes++ > 0);
    EXPECT_EQ(keyframe->time_s, frame.left_time_s);
    ASSERT_GT(keyframe->corners.size(), 50u);
    EXPECT_EQ(keyframe->descriptors.size(), 2 * keyframe->corners.size());
    const Eigen::Isometry3d T_room_camera = test::roomDrive(frame.left_time_s);
    const Eigen::Isometry3d T_true = test::roomDrive(previous_s).inverse() * T_room_camera;
    EXPECT_LT((keyframe->T_previous_keyframe.translation() - T_true.translation()).norm(), 0.02);
    EXPECT_EQ(keyframe->covariance.trace() > 0.0, keyframe->follows);
    previous_s = frame.left_time_s;
    int near = 0;
    for (const vision::KeyframeCorner& corner : keyframe->corners) {
      EXPECT_NE(corner.landmark_id, 0u);
      EXPECT_GT(corner.disparity_sigma_px, 0.0);
      const Eigen::Vector3d p_camera =
          test::roomCalibration().backProject(corner.px.x(), corner.px.y(), 1.0).normalized();
      const double range_m =
          test::TexturedRoom().distance(T_room_camera.translation(), T_room_camera.linear() * p_camera);
      const double true_disparity_px =
          test::roomCalibration().fx * test::roomCalibration().baseline_m / (range_m * p_camera.z());
      if (std::abs(corner.disparity_px - true_disparity_px) < 3.0 * corner.disparity_sigma_px) ++near;
    }
    EXPECT_GT(near, static_cast<int>(0.9 * static_cast<double>(keyframe->corners.size())));
  }
  EXPECT_GE(keyframes, 2);
}

TEST(KeyframeMakerTest, MakingThemChangesNothingOfThePath) {
  const auto alone = defaultOdometry(), watched = defaultOdometry();
  KeyframeMaker maker;
  for (const StereoFrame& frame : roomFrames()) {
    const FrameResult expected = alone->process(frame), result = watched->process(frame);
    maker.add(frame, result);
    EXPECT_EQ(expected.T_start_camera.matrix(), result.T_start_camera.matrix());
    EXPECT_EQ(expected.motion_covariance, result.motion_covariance);
  }
}

TEST(KeyframeMakerTest, AfterAPauseOrAResetItFollowsNoneAndIdsGoOn) {
  const auto odometry = defaultOdometry();
  KeyframeMaker maker;
  std::vector<vision::Keyframe> keyframes;
  for (int run = 0; run < 3; ++run) {
    if (run == 1) maker.pause();
    if (run > 0) odometry->reset();
    for (std::size_t i = 0; i < 2; ++i) {
      if (const auto keyframe = maker.add(roomFrames()[i], odometry->process(roomFrames()[i])))
        keyframes.push_back(*keyframe);
    }
  }
  ASSERT_GE(keyframes.size(), 3u);
  int starts = 0;
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    if (!keyframes[i].follows) ++starts;
    if (i == 0) continue;
    EXPECT_GT(keyframes[i].id, keyframes[i - 1].id);
    if (keyframes[i].follows) continue;
    EXPECT_GT(keyframes[i].corners.front().landmark_id, keyframes[i - 1].corners.back().landmark_id)
        << "landmarks of another run are not the same";
  }
  EXPECT_EQ(starts, 3);
}

}  // namespace
}  // namespace stereo_nav::odometry
