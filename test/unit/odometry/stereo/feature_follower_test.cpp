#include "odometry/stereo/feature_follower.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "odometry/stereo/landmark_detector.h"
#include "room_course.h"

namespace stereo_nav::odometry {
namespace {

constexpr int kLevels = 4;

/// The room at the start of its drive, with the landmarks that are detected there.
class FeatureFollowerTest : public StereoOdometryTest {
 protected:
  FeatureFollowerTest() {
    map.start(WindowFrame());
    const LandmarkDetector::Result found =
        detector.detect({first, shutter, vision::StereoView(), Vector6d::Zero(), 0.0}, {}, matcher);
    for (const NewLandmark& detected : found.landmarks) {
      Track track;
      track.landmark_id = map.addLandmark(detected.landmark, detected.at_stamp);
      track.p_world = detected.landmark.p_world();
      track.in_image = track.at_stamp = detected.in_image;
      track.keyframe_px = track.previous_px = detected.in_image.left_px;
      track.found = track.inlier = true;
      follower.add(track);
    }
    follower.startKeyframe(first.left);
    corners = found.corners;
  }

  StereoImages imagesAt(double time_s, double offset_s = 0.0) const {
    return {frameAt(time_s, offset_s), kLevels};
  }
  vision::StereoView viewAt(double time_s) const {
    vision::StereoView view;
    view.T_camera_world = test::roomDrive(time_s).inverse() * test::roomDrive(0.0);
    return view;
  }
  FramePrediction predictionAt(double time_s) const {
    return {calibration, shutter, viewAt(time_s), Vector6d::Zero(), Eigen::Isometry3d::Identity()};
  }
  /// Share of all tracks that were found less than a pixel from where the true motion puts them.
  double rightShare(double time_s) const {
    const TrackIndices near = tracksNear(calibration, viewAt(time_s), 1.0, withStampsOfImages());
    return static_cast<double>(near.size()) / static_cast<double>(follower.tracks().size());
  }
  std::vector<Track> withStampsOfImages() const {
    std::vector<Track> tracks = follower.tracks();
    for (Track& track : tracks) track.at_stamp = track.in_image;
    return tracks;
  }

  vision::RollingShutter shutter{calibration};
  RightImageMatcher matcher{vision::SparseStereoParams(), calibration};
  LandmarkDetector detector{vision::GridCornerDetectorParams(), calibration};
  LocalMap map{12, WindowOptimizerParams(), calibration};
  FeatureFollower follower{vision::PatchTrackerParams(), kLevels};
  StereoImages first = imagesAt(0.0);
  std::size_t corners = 0;
};

TEST_F(FeatureFollowerTest, LandmarksAreDetectedAtTheirTrueDepths) {
  ASSERT_GE(follower.tracks().size(), 60u);
  EXPECT_GE(corners, follower.tracks().size());
  std::size_t good = 0;
  for (const Track& track : follower.tracks()) {
    const Eigen::Vector3d ray = track.p_world / track.p_world.z();
    const double depth_m =
        room.distance(test::roomDrive(0.0).translation(), test::roomDrive(0.0).linear() * ray);
    // A third of a pixel of disparity.
    const double sigma_m = 0.33 * depth_m * depth_m / (calibration.fx * calibration.baseline_m);
    if (std::abs(track.p_world.z() - depth_m) < sigma_m) ++good;
  }
  EXPECT_GE(good, follower.tracks().size() * 9 / 10);
}

TEST_F(FeatureFollowerTest, NewLandmarksStayAwayFromTracksThatAreAlive) {
  const auto again = detector.detect({first, shutter, vision::StereoView(), Vector6d::Zero(), 0.0},
                                     follower.tracks(), matcher);
  for (const NewLandmark& landmark : again.landmarks) {
    for (const Track& track : follower.tracks())
      EXPECT_GE((landmark.in_image.left_px - track.in_image.left_px).norm(), 9.5);
  }
  EXPECT_GE(detector.countCorners(first.left), 60u);
}

TEST_F(FeatureFollowerTest, FollowsWithAndWithoutPrediction) {
  for (const bool is_predicted : {true, false}) {
    follower.follow(imagesAt(0.1).left, predictionAt(0.1), is_predicted);
    EXPECT_GE(rightShare(0.1), 0.85) << is_predicted;
  }
}

TEST_F(FeatureFollowerTest, OnlyInliersMoveThePreviousPixelAndAreConfirmed) {
  follower.follow(imagesAt(0.1).left, predictionAt(0.1), true);
  Track& inlier = follower.tracks().front();
  Track& outlier = follower.tracks().back();
  EXPECT_EQ(inlier.confirmations, 1) << "the frame of its detection";
  EXPECT_FALSE(inlier.fresh);
  EXPECT_FALSE(inlier.inlier);
  inlier.inlier = true;
  const Eigen::Vector2d inlier_px = inlier.in_image.left_px;
  const Eigen::Vector2d outlier_px = outlier.previous_px;
  follower.follow(imagesAt(0.2).left, predictionAt(0.2), true);
  EXPECT_EQ(follower.tracks().front().previous_px, inlier_px);
  EXPECT_EQ(follower.tracks().front().confirmations, 2);
  EXPECT_EQ(follower.tracks().back().previous_px, outlier_px);
  EXPECT_EQ(follower.tracks().back().confirmations, 1);
}

TEST_F(FeatureFollowerTest, FindsFeaturesInABlurredImageAtHalfTheResolution) {
  StereoFrame blurred = frameAt(0.1);
  cv::blur(blurred.left, blurred.left, {11, 11});
  follower.follow(StereoImages(blurred, kLevels).left, predictionAt(0.1), true);
  std::size_t coarse = 0;
  for (const Track& track : follower.tracks()) {
    if (track.found && track.in_image.noise == 2.0) ++coarse;
  }
  EXPECT_GE(coarse, 15u);
}

TEST_F(FeatureFollowerTest, RecoversWhatAPoorPredictionMissed) {
  const StereoImages images = imagesAt(0.1);
  follower.follow(images.left, predictionAt(0.1), true);
  for (Track& track : follower.tracks()) track.inlier = track.found;
  Track& missed = follower.tracks().at(3);
  missed.found = missed.inlier = false;
  const TrackIndices recovered = follower.recover(images.left, predictionAt(0.1));
  EXPECT_TRUE(std::find(recovered.begin(), recovered.end(), 3u) != recovered.end());
}

TEST_F(FeatureFollowerTest, ANewKeyframeDropsOutliersOnceTheyAreReported) {
  follower.follow(imagesAt(0.1).left, predictionAt(0.1), true);
  for (Track& track : follower.tracks()) track.inlier = track.found;
  follower.tracks().at(2).inlier = false;
  const std::size_t before = follower.tracks().size();
  const std::uint64_t outlier = follower.tracks().at(2).landmark_id;
  const StereoImages images = imagesAt(0.1);
  follower.startKeyframe(images.left);
  EXPECT_FALSE(follower.tracks().at(2).alive);
  EXPECT_EQ(follower.tracks().at(0).keyframe_px, follower.tracks().at(0).in_image.left_px);
  EXPECT_EQ(follower.tracks().size(), before);
  std::vector<std::uint64_t> others;
  for (const Track& track : follower.tracks()) {
    if (track.landmark_id != outlier) others.push_back(track.landmark_id);
  }
  map.removeUnused(others);
  follower.removeTracksWithout(map);
  EXPECT_EQ(follower.tracks().size(), before - 1);
}

TEST_F(FeatureFollowerTest, TakesThePointsOverFromTheMap) {
  map.landmarks().front().ray_depth.z() *= 0.5;
  follower.updatePoints(map);
  EXPECT_EQ(follower.tracks().front().p_world, map.landmarks().front().p_world());
}

TEST_F(FeatureFollowerTest, MatchesTracksIntoTheRightImageOfTheirOwnTime) {
  const StereoImages images = imagesAt(0.1, 0.05);
  vision::StereoView view = viewAt(0.1);
  view.T_late_camera = test::roomDrive(0.15).inverse() * test::roomDrive(0.1);
  follower.follow(images.left, predictionAt(0.1), true);
  matcher.match(images, view, 0.0, follower.tracks());
  std::size_t good = 0;
  for (const Track& track : follower.tracks()) {
    if (!track.found || !track.in_image.has_right) continue;
    const Eigen::Vector2d expected_px =
        vision::projectRight(calibration, view.T_late_camera * view.T_camera_world * track.p_world);
    if ((track.in_image.right_px - expected_px).norm() < 1.0) ++good;
  }
  EXPECT_GE(good, follower.tracks().size() * 3 / 4);
}

TEST_F(FeatureFollowerTest, LearnsTheRowsOfAMisalignedRightCamera) {
  StereoFrame frame = frameAt(0.0);
  const cv::Mat down = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, 1.2);
  cv::warpAffine(frame.right.clone(), frame.right, down, frame.right.size(), cv::INTER_CUBIC,
                 cv::BORDER_REPLICATE);
  const StereoImages images(frame, kLevels);
  auto found = detector.detect({images, shutter, vision::StereoView(), Vector6d::Zero(), 0.0}, {}, matcher);
  ASSERT_GE(found.landmarks.size(), 40u);
  const auto rowErrors = [&found] {
    std::vector<double> errors_px;
    for (const NewLandmark& landmark : found.landmarks)
      errors_px.push_back(std::abs(landmark.at_stamp.right_px.y() - landmark.at_stamp.left_px.y()));
    std::sort(errors_px.begin(), errors_px.end());
    return errors_px[errors_px.size() / 2];
  };
  EXPECT_NEAR(rowErrors(), 1.2, 0.2);
  matcher.learnRowsAtStart(found.landmarks);
  EXPECT_LT(rowErrors(), 0.2);
}

TEST_F(FeatureFollowerTest, AnUncertainMotionBetweenTheStampsWidensTheEpipolarLines) {
  Vector6d sigma = Vector6d::Zero();
  EXPECT_EQ(matcher.slack_px(sigma), 0.0);
  sigma.tail<3>().setConstant(0.01);
  EXPECT_NEAR(matcher.slack_px(sigma), 0.01 * calibration.fx, 1e-9);
  sigma.head<3>().setConstant(0.03);  // 0.01 rad for a point at 3 m
  EXPECT_NEAR(matcher.slack_px(sigma), 0.02 * calibration.fx, 1e-9);
}

}  // namespace
}  // namespace stereo_nav::odometry
