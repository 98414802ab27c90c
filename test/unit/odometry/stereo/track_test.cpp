#include "odometry/stereo/track.h"

#include <gtest/gtest.h>

#include "odometry/stereo/frame_prediction.h"
#include "odometry/stereo/frame_report.h"
#include "odometry/stereo/keyframe_decision.h"
#include "odometry/stereo/rigid_selection.h"
#include "support/textured_room.h"
#include "synthetic_map.h"

namespace stereo_nav::odometry {
namespace {

class TrackTest : public ::testing::Test {
 protected:
  /// Tracks of points ahead of the origin, found where `view` sees them.
  std::vector<Track> tracksOf(const std::vector<Eigen::Vector3d>& points, const vision::StereoView& view) {
    std::vector<Track> tracks;
    for (const Eigen::Vector3d& p : points) {
      Track track;
      track.landmark_id = tracks.size() + 1;
      track.p_world = p;
      track.in_image = track.at_stamp = test::observe(calibration, view, p, 0.0, random);
      track.previous_px = track.keyframe_px = track.in_image.left_px;
      track.found = track.inlier = true;
      track.fresh = false;
      tracks.push_back(track);
    }
    return tracks;
  }

  vision::StereoCalibration calibration = test::roomCalibration();
  vision::RollingShutter shutter{calibration};
  std::mt19937 random{3};
};

TEST_F(TrackTest, ReliableTracksHaveBeenConfirmedWhereThereAreEnoughOfThem) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(30, 1), vision::StereoView());
  for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].confirmations = i < 18 ? 3 : 1;
  selectReliableTracks(12, tracks);
  for (std::size_t i = 0; i < tracks.size(); ++i) EXPECT_EQ(tracks[i].reliable, i < 18) << i;
  tracks[0].found = false;  // now 17 are left of the 18 that are enough
  selectReliableTracks(12, tracks);
  for (std::size_t i = 0; i < tracks.size(); ++i) EXPECT_EQ(tracks[i].reliable, i > 0) << i;
}

TEST_F(TrackTest, TracksNearAViewAreThoseThatItExplains) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(10, 1), vision::StereoView());
  tracks[2].at_stamp.left_px.x() += 2.9;
  tracks[4].at_stamp.left_px.x() += 3.1;
  tracks[6].found = false;
  EXPECT_EQ(tracksNear(calibration, vision::StereoView(), 3.0, tracks),
            (TrackIndices{0, 1, 2, 3, 5, 7, 8, 9}));
}

TEST_F(TrackTest, APointBehindTheCameraIsExpectedWhereItWas) {
  std::vector<Track> tracks = tracksOf({{0.1, 0.2, 2.0}}, vision::StereoView());
  vision::StereoView beyond;
  beyond.T_camera_world.translation().z() = -2.5;
  EXPECT_EQ(predictedPixel(calibration, beyond, tracks[0]), tracks[0].previous_px);
}

TEST_F(TrackTest, AGlobalShutterLeavesTheObservations) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(5, 1), vision::StereoView());
  for (Track& track : tracks) track.at_stamp = vision::StereoObservation();
  compensateRollingShutter(shutter, vision::StereoView(), Vector6d::Constant(0.5), tracks);
  for (const Track& track : tracks) EXPECT_EQ(track.at_stamp.left_px, track.in_image.left_px);
}

TEST_F(TrackTest, ARollingShutterIsCompensatedForTheTracksThatWereFound) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(5, 1), vision::StereoView());
  tracks[1].found = false;
  Vector6d twist = Vector6d::Zero();
  twist[0] = 0.5;
  shutter.setReadout(0.03);
  compensateRollingShutter(shutter, vision::StereoView(), twist, tracks);
  for (const std::size_t i : {0u, 2u, 3u, 4u}) {
    const double time_s = shutter.leftTime_s(tracks[i].in_image.left_px);
    const double moved_px = calibration.fx * 0.5 * time_s / tracks[i].p_world.z();
    EXPECT_NEAR(tracks[i].at_stamp.left_px.x(), tracks[i].in_image.left_px.x() - moved_px, 1e-6);
  }
  EXPECT_EQ(tracks[1].at_stamp.left_px, tracks[1].in_image.left_px) << "left as it was";
}

TEST_F(TrackTest, PredictsPixelZoomAndRollOfAPatch) {
  const std::vector<Track> tracks = tracksOf({{0.2, 0.1, 2.0}}, vision::StereoView());
  vision::StereoView nearer;
  nearer.T_camera_world.linear() = expRotation({0.0, 0.0, 0.2});
  nearer.T_camera_world.translation().z() = -0.5;
  const FramePrediction prediction(calibration, shutter, nearer, Vector6d::Zero(),
                                   Eigen::Isometry3d::Identity());
  const Eigen::Vector3d p_camera = nearer.T_camera_world * tracks[0].p_world;
  EXPECT_TRUE(prediction.leftPixel(tracks[0]).isApprox(vision::projectLeft(calibration, p_camera)));
  // At 1.5 m instead of 2 m a pixel spans three quarters as much; the image turned by 0.2 rad.
  const Eigen::Matrix2f expected = (0.75 * Eigen::Rotation2Dd(-0.2).toRotationMatrix()).cast<float>();
  EXPECT_TRUE(prediction.patchStep(tracks[0]).isApprox(expected, 1e-5F));
}

TEST_F(TrackTest, AZoomBeyondTwoIsNotBelieved) {
  const std::vector<Track> tracks = tracksOf({{0.0, 0.0, 2.0}}, vision::StereoView());
  vision::StereoView nearer;
  nearer.T_camera_world.translation().z() = -1.5;
  const FramePrediction prediction(calibration, shutter, nearer, Vector6d::Zero(),
                                   Eigen::Isometry3d::Identity());
  EXPECT_TRUE(prediction.patchStep(tracks[0]).isIdentity());
}

TEST_F(TrackTest, TheRigidSelectionLeavesOutWhatMovesOnItsOwn) {
  vision::StereoView view;
  view.T_camera_world.translation() << 0.05, 0.0, -0.2;
  std::vector<Track> tracks = tracksOf(test::pointsAhead(30, 2), view);
  tracks[7].p_world += Eigen::Vector3d(0.5, 0.0, 0.0);
  tracks[9].at_stamp.has_right = false;
  tracks[11].reliable = false;
  const RigidSelection rigid = selectRigidTracks(CliqueParams(), NoisyRigidityParams(), calibration,
                                                 Eigen::Isometry3d::Identity(), view, tracks);
  EXPECT_EQ(rigid.with_depth, 28u);
  EXPECT_EQ(rigid.tracks.size(), 27u);
  for (const std::size_t i : rigid.tracks) EXPECT_TRUE(i != 7 && i != 9 && i != 11) << i;
}

TEST_F(TrackTest, TheRigidSelectionIsSoughtAmongOldAndYoungAlike) {
  const std::vector<Track> tracks = tracksOf(test::pointsAhead(40, 2), vision::StereoView());
  CliqueParams params;
  params.clique_points = 10;
  const RigidSelection rigid = selectRigidTracks(params, NoisyRigidityParams(), calibration,
                                                 Eigen::Isometry3d::Identity(), vision::StereoView(), tracks);
  EXPECT_EQ(rigid.tracks, (TrackIndices{0, 4, 8, 12, 16, 20, 24, 28, 32, 36}));
}

TEST_F(TrackTest, AKeyframeIsNeededWhenFewFeaturesAreLeft) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(59, 2), vision::StereoView());
  EXPECT_FALSE(needsKeyframe(KeyframeParams(), tracks, 98));
  EXPECT_TRUE(needsKeyframe(KeyframeParams(), tracks, 100)) << "59 of 100 are less than 0.6";
  EXPECT_TRUE(needsKeyframe(KeyframeParams(), {}, 0));
}

TEST_F(TrackTest, AKeyframeIsNeededBeforeFeaturesHaveMovedTooFar) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(21, 2), vision::StereoView());
  for (Track& track : tracks) {
    track.keyframe_px = track.in_image.left_px - Eigen::Vector2d(30.0, 0.0);
    track.previous_px = track.in_image.left_px - Eigen::Vector2d(9.9, 0.0);
  }
  EXPECT_FALSE(needsKeyframe(KeyframeParams(), tracks, 21)) << "39.9 px in the next frame";
  for (Track& track : tracks) track.previous_px.x() -= 0.2;
  EXPECT_TRUE(needsKeyframe(KeyframeParams(), tracks, 21)) << "40.1 px in the next frame";
}

TEST_F(TrackTest, TheReportTellsTheFateOfEachTrackThatWasFound) {
  std::vector<Track> tracks = tracksOf(test::pointsAhead(5, 2), vision::StereoView());
  tracks[1].inlier = false;
  tracks[2].inlier = tracks[2].at_stamp.has_right = false;
  tracks[3].fresh = true;
  tracks[4].found = false;
  FrameResult result;
  reportTracks(tracks, Eigen::Isometry3d::Identity(), result);
  ASSERT_EQ(result.features.size(), 4u);
  using Fate = FeatureReport::Fate;
  const std::vector<Fate> fates{Fate::kInlier, Fate::kRejected, Fate::kNoDepth, Fate::kDetected};
  for (std::size_t i = 0; i < fates.size(); ++i) {
    EXPECT_EQ(result.features[i].fate, fates[i]) << i;
    EXPECT_EQ(result.features[i].id, i + 1);
    EXPECT_EQ(result.features[i].p_camera, tracks[i].p_world);
  }
  EXPECT_EQ(result.inliers, 1u);
}

}  // namespace
}  // namespace stereo_nav::odometry
