#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odometry/stereo/imu_rotation.h"
#include "odometry/stereo/noisy_rigidity.h"
#include "odometry/stereo/pose_estimator.h"
#include "odometry/stereo/window_optimizer.h"
#include "stereo_nav/odometry/common/odometry.h"
#include "vision/grid_corner_detector.h"
#include "vision/patch_tracker.h"
#include "vision/rolling_shutter.h"
#include "vision/sparse_stereo.h"

namespace stereo_nav::odometry {

struct KeyframeParams {
  int window = 12;
  double min_tracked_share = 0.6;
  double max_parallax_px = 40.0;

  void describe(ParameterVisitor& visitor);
};

struct StereoParams {
  int pyramid_levels = 4;
  vision::GridCornerDetectorParams corners;
  vision::PatchTrackerParams tracking;
  vision::SparseStereoParams stereo;
  NoisyRigidityParams rigidity;
  int clique_points = 200;
  int clique_budget = 2000;
  PoseEstimatorParams motion;
  WindowOptimizerParams window;
  KeyframeParams keyframes;
  ImuRotationParams imu;
  int min_inliers = 12;
  int max_coasting_frames = 3;
  double acceleration_density = 1.0;
  double angular_acceleration_density = 4.0;

  void describe(ParameterVisitor& visitor);
};

/// The default composition: corners tracked from the last keyframe with prediction, matched into the right
/// image at its own time, freed from outliers by rigidity, motion by robust reprojection, and keyframes and
/// landmarks refined together in a small window. Needs no disparity map; uses the IMU's rotation where there
/// is one.
class StereoOdometry : public Odometry {
 public:
  StereoOdometry(const StereoParams& params, const vision::StereoCalibration& calibration,
                 const Eigen::Matrix3d& R_camera_imu);

  void addImu(const ImuSample& sample) override { imu_.add(sample); }
  FrameResult process(const StereoFrame& frame) override;
  void reset() override;

 private:
  /// A landmark's way through the images since the last keyframe.
  struct Track {
    Eigen::Vector2d keyframe_px;
    Eigen::Vector2d last_px;
    vision::StereoObservation in_image;  ///< in the current frame, pixels of the images
    vision::StereoObservation seen;      ///< the same, freed from the rolling shutter
    bool alive = true;                   ///< may still be found in the next frame
    bool found = false;                  ///< in the current frame
    bool inlier = false;
    bool fresh = true;      ///< detected in the current frame
    bool votes = true;      ///< its observation moves the pose
    int confirmations = 0;  ///< earlier frames in which it was an inlier, that of its detection included
  };
  /// The two images of a frame with their times.
  struct Images {
    vision::ImagePyramid left;
    vision::ImagePyramid right;
    double left_time_s = 0.0;
    double right_time_s = 0.0;
    double skew_s() const { return right_time_s - left_time_s; }
  };

  /// Throws std::invalid_argument that says what is wrong with it.
  void checkFrame(const StereoFrame& frame) const;
  void startAt(const Images& images, const Eigen::Isometry3d& T_camera_world, FrameResult& result);
  bool followOrSearch(const Images& images, FrameResult& result);
  /// Where a new map begins: at the last position, turned as the IMU says, if it does.
  Eigen::Isometry3d turnedSinceLast(const Images& images) const;
  /// Nothing in the picture to measure motion by, nor to begin a new map from.
  bool isBlank(const Images& images, FrameResult& result);
  bool follow(const Images& images, FrameResult& result);
  /// Pose, and the motion between skewed stamps, as far as the left image alone tells.
  vision::StereoView leftOnlyView(const MotionPrior& prior, const vision::StereoView& predicted);
  MotionPrior motionPrior(const Images& images) const;
  vision::StereoView predict(const Images& images, const MotionPrior& prior) const;
  /// Unless `moved_as_predicted`, by the velocity or the IMU, features are looked for where they were.
  void trackAll(const Images& images, const vision::StereoView& predicted, bool moved_as_predicted);
  /// More than half of the tracks that were alive.
  bool lostMany() const;
  /// A turn that nothing predicted is looked for in the picture as a whole.
  void trackAfterTurn(const Images& images);
  /// What motion blur left of the features is seen at half the resolution.
  void trackBlurred(const Images& images, const vision::StereoView& predicted, bool moved_as_predicted);
  /// The motion is decided by tracks that have moved with the scene before, where they are enough: what comes
  /// into view on its own way gets no vote for having been seen twice.
  void appointVoters();
  bool trackOne(const Images& images, std::size_t i, const Eigen::Vector2d& guess_px, int top_level,
                const Eigen::Matrix2f& step, int finest_level);
  Eigen::Matrix2f patchStep(std::size_t i, const vision::StereoView& view) const;
  /// Twist in the current frame, should `view` be its pose.
  Vector6d twistAt(const vision::StereoView& view, const MotionPrior& prior) const;
  /// What is seen in the current frame, freed from the rolling shutter as far as `view` tells the motion.
  void straighten(const vision::StereoView& view, const MotionPrior& prior);
  /// The same for the first frame, once the second one has told how fast it moved.
  void straightenStart(const Vector6d& twist);
  /// Of a new landmark, seen in the frame with this view and twist; its depth is that of the pixels in the
  /// images.
  void placeAtStamp(Landmark& landmark, vision::StereoObservation& seen, const vision::StereoView& view,
                    const Vector6d& twist) const;
  void matchStereo(const Images& images, const vision::StereoView& view, double slack_px);
  void matchStereoOne(const Images& images, std::size_t i, const vision::StereoView& view, double slack_px);
  bool hasEnoughInliers(const PoseEstimate& estimate) const;
  /// So few of the tracks agree that the prediction was probably poor.
  bool isThin(const PoseEstimate& estimate) const;
  /// Looks again for what was not found or did not fit, where the estimated motion has it.
  std::size_t recover(const Images& images, const vision::StereoView& view);
  double epipolarSlack(const Vector6d& late_sigma) const;
  std::vector<std::size_t> foundTracks() const;
  PoseEstimate estimateFrom(const std::vector<std::size_t>& tracks, const MotionPrior& prior,
                            const vision::StereoView& guess) const;
  /// The motion that most features agree on begins as nothing that drives or flies could begin it: they are
  /// on something that moves on its own.
  bool isCarriedAway(const PoseEstimate& estimate, const MotionPrior& prior) const;
  /// Whatever fills the view may pass: for a while the features seen before are worth waiting for.
  bool waitsForMovers(const Images& images) const;
  /// If not, `result` tells why.
  bool isAcceptable(const PoseEstimate& estimate, const MotionPrior& prior, FrameResult& result);
  /// Tracks found where `view` has them.
  std::vector<std::size_t> tracksNear(const vision::StereoView& view) const;
  std::vector<std::size_t> cliqueCandidates(const std::vector<std::size_t>& found) const;
  std::vector<std::size_t> selectRigid(const vision::StereoView& view, FrameResult& result) const;
  PoseEstimate estimatePose(const std::vector<std::size_t>& selected, const MotionPrior& prior,
                            const vision::StereoView& guess);
  void updateTwist(const Images& images, const MotionPrior& prior);
  void expectSkew(const Images& images, const MotionPrior& prior);
  void smoothPreviousSkew(const Images& images);
  void refineWindow();
  /// What the rows of the right image are off, from how the found features lie in both images.
  void learnEpipolarError();
  void learnEpipolarErrorAtStart();
  bool needsKeyframe() const;
  void makeKeyframe(const Images& images, FrameResult& result);
  void replenish(const Images& images, FrameResult& result);
  void dropOldFrames();
  void compact();
  void report(FrameResult& result) const;
  /// Of a landmark at the stamp, and in the image, whose rows have times of their own.
  Eigen::Vector2d predictedPixel(std::size_t i, const vision::StereoView& view) const;
  Eigen::Vector2d predictedInImage(std::size_t i, const vision::StereoView& view) const;

  StereoParams params_;
  vision::StereoCalibration calibration_;
  vision::GridCornerDetector detector_;
  vision::PatchTracker tracker_;
  vision::SparseStereoMatcher stereo_;
  PoseEstimator estimator_;
  WindowOptimizer optimizer_;
  ImuRotation imu_;

  // Of the current frame.
  vision::RollingShutter shutter_;
  Vector6d row_twist_ = Vector6d::Zero();  ///< along which its rows are brought to one time

  // The map. The world is the left camera of the first frame.
  std::vector<WindowFrame> window_;  ///< keyframes, oldest first, and the current frame at the end
  std::vector<Landmark> landmarks_;
  std::vector<Track> tracks_;  ///< of the landmark with the same index
  vision::ImagePyramid keyframe_image_;
  std::size_t keyframe_inliers_ = 0;
  std::uint32_t keyframe_id_ = 0;
  std::uint64_t next_id_ = 1;

  // The previous frame that had a pose.
  bool last_is_keyframe_ = false;
  bool start_is_bent_ = false;  ///< the first frame is not freed from the rolling shutter yet
  double last_left_time_s_ = 0.0;
  double last_skew_s_ = 0.0;
  double last_interval_s_ = 0.0;
  vision::StereoView last_view_;
  Eigen::Isometry3d T_last_before_ = Eigen::Isometry3d::Identity();  ///< its motion since the one before
  std::optional<Vector6d> twist_;  ///< of the world in the camera frame at the last left stamp, m/s and rad/s
  int failures_ = 0;
  bool movers_fill_view_ = false;  ///< since the last frame that had a pose
};

}  // namespace stereo_nav::odometry
