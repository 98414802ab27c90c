#pragma once

#include <optional>

#include "odometry/stereo/calibration_effects.h"
#include "odometry/stereo/consensus.h"
#include "odometry/stereo/feature_follower.h"
#include "odometry/stereo/landmark_detector.h"
#include "odometry/stereo/local_map.h"
#include "odometry/stereo/motion_model.h"
#include "odometry/stereo/right_image_matcher.h"
#include "odometry/stereo/stereo_params.h"

namespace stereo_nav::odometry {

/// The default composition: corners are followed from the last keyframe with prediction, matched into the
/// right image at its own time and freed from outliers by rigidity; the motion comes from robust
/// reprojection; keyframes and landmarks are refined together in a small window. It needs no disparity map
/// and uses the IMU's rotation where there is one (docs/method.md).
class StereoOdometry : public Odometry {
 public:
  StereoOdometry(const StereoParams& params, const vision::StereoCalibration& calibration,
                 const Eigen::Matrix3d& R_camera_imu);

  void addImu(const ImuSample& sample) override { motion_.addImu(sample); }
  FrameResult process(const StereoFrame& frame) override;
  void reset() override;

 private:
  /// The pose of the current frame; nothing, and the reason in `result`, if its features do not tell.
  std::optional<PoseEstimate> estimatePose(const StereoImages& images, const MotionPrior& prior,
                                           FrameResult& result);
  /// Finds the tracks in the right image. Returns the predicted view, improved where the stamps differ.
  vision::StereoView matchRightImage(const StereoImages& images, const MotionPrior& prior,
                                     const vision::StereoView& predicted);
  /// The largest rigid set of tracks, or all that were found if it is too small.
  TrackIndices selectRigid(const MotionPrior& prior, const vision::StereoView& view,
                           FrameResult& result) const;
  PoseEstimate estimateFrom(const TrackIndices& selected, const MotionPrior& prior,
                            const vision::StereoView& guess) const;
  /// Estimates the pose from the selected tracks, then from all that agree with that motion.
  PoseEstimate estimateRobustly(const TrackIndices& selected, const MotionPrior& prior,
                                const vision::StereoView& guess);
  bool hasEnoughInliers(const PoseEstimate& estimate) const;
  /// Whether so few of the tracks agree that the prediction was probably poor.
  bool hasFewInliers(const PoseEstimate& estimate) const;
  bool exceedsAcceleration(const PoseEstimate& estimate, const MotionPrior& prior) const;
  /// Whether two motions have nearly the same support and nothing else decides between them.
  bool isAmbiguous(const Consensus& consensus) const;
  /// If the estimate is not acceptable, `result` tells why.
  bool isAcceptable(const PoseEstimate& estimate, const MotionPrior& prior, const FrameTimes& times,
                    FrameResult& result) const;
  /// Looks again for what was not found or did not fit, near the pose `view`. Returns whether it found any.
  bool recoverTracks(const StereoImages& images, const vision::StereoView& view);
  FramePrediction prediction(const vision::StereoView& view) const;
  /// Frees the tracks from the rolling shutter, using the motion that `view` implies.
  void compensateRows(const MotionPrior& prior, const vision::StereoView& view);
  /// Brings the landmarks of a first frame to its stamp, once the second frame has told the twist there.
  void compensateStart(const Vector6d& twist);

  /// Refines the map with the current frame, which becomes a keyframe or leaves the map again.
  void updateMap(const StereoImages& images, const MotionPrior& prior, const PoseEstimate& estimate,
                 FrameResult& result);
  void startMap(const StereoImages& images, const Eigen::Isometry3d& T_camera_world, FrameResult& result);
  void makeKeyframe(const StereoImages& images, FrameResult& result);
  void addLandmarks(const StereoImages& images, FrameResult& result);
  /// Waits for the features seen before, or begins a new map.
  void handleLoss(const StereoImages& images, FrameResult& result);
  /// Begins a map at the pose to which the rig has coasted.
  void startMapCoasting(const StereoImages& images, FrameResult& result);
  /// Sets the pose to the one to which the rig has coasted. Returns whether its velocity is known.
  bool coast(const FrameTimes& times, FrameResult& result);
  /// Whether enough frames have agreed with the map since it began. Before, nothing is tracked.
  bool isConfirmed() const { return confirmations_ >= kConfirmations; }

  StereoParams params_;
  vision::StereoCalibration calibration_;
  Eigen::Matrix3d R_camera_imu_;
  PoseEstimator estimator_;
  CalibrationEffectsModel effects_;
  vision::RollingShutter shutter_;         ///< of the current frame
  Vector6d row_twist_ = Vector6d::Zero();  ///< motion used to bring the rows of the current frame to one time

  MotionModel motion_;
  FeatureFollower follower_;
  RightImageMatcher matcher_;
  LandmarkDetector detector_;
  LocalMap map_;

  /// Factor of the covariances: the errors of a feature add up from view to view (docs/method.md).
  static constexpr double kDependence = 3.0;
  static constexpr int kConfirmations = 2;  ///< frames after the first one
  int confirmations_ = 0;                   ///< frames that agreed with the map in use
  Eigen::Isometry3d T_camera_world_ = Eigen::Isometry3d::Identity();  ///< of the newest frame, as reported

  std::uint32_t keyframe_id_ = 0;
  std::size_t keyframe_features_ = 0;  ///< tracks of the last keyframe
  bool previous_is_keyframe_ = false;  ///< whether the last frame that had a pose was a keyframe

  bool start_needs_compensation_ = false;  ///< the first frame is not freed from the rolling shutter yet
  int lost_frames_ = 0;            ///< since the last tracked frame; a new map alone does not end the count
  bool mover_fills_view_ = false;  ///< something that moves on its own has done so since the map began
};

}  // namespace stereo_nav::odometry
