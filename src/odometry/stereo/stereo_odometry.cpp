#include "odometry/stereo/stereo_odometry.h"

#include <cmath>

#include "odometry/common/stage_clock.h"
#include "odometry/stereo/frame_check.h"
#include "odometry/stereo/frame_report.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {

StereoOdometry::StereoOdometry(const StereoParams& params, const vision::StereoCalibration& calibration,
                               const Eigen::Matrix3d& R_camera_imu)
    : params_(params),
      calibration_(calibration),
      R_camera_imu_(R_camera_imu),
      estimator_(params.motion, calibration),
      effects_(params.motion.loss_px, calibration),
      shutter_(calibration),
      motion_(params.motion_model, params.imu, R_camera_imu),
      follower_(params.tracking, params.pyramid_levels),
      matcher_(params.stereo, calibration),
      detector_(params.corners, calibration),
      map_(params.keyframes.window, params.window, calibration) {
  validateParameters(params, "stereo");
  calibration.validate();
}

void StereoOdometry::reset() {
  // An odometry made anew has nothing that could survive.
  *this = StereoOdometry(params_, calibration_, R_camera_imu_);
}

FrameResult StereoOdometry::process(const StereoFrame& frame) {
  checkFrame(frame, calibration_);
  if (!map_.empty()) checkOrder(frame, motion_.previousTimes().left_s);
  FrameResult result;
  StageClock clock(result.stage_times);
  const StereoImages images(frame, params_.pyramid_levels, matcher_.stampError().takenOff_s());
  shutter_.setReadout(frame.readout_s);
  clock.lap("pyramid");

  if (map_.empty()) {
    result.state = keyframe_id_ == 0 ? State::kInitialising : State::kLost;
    result.reason = "no map yet: this frame has nothing to measure its motion against";
    startMapCoasting(images, result);
  } else {
    MotionPrior prior = motion_.prior(images.times);
    std::optional<PoseEstimate> estimate = estimatePose(images, prior, result);
    if (!estimate && motion_.forgetVelocity()) {
      // After a sudden stop, or a gap in the images, the velocity leads the search astray.
      prior = motion_.prior(images.times);
      estimate = estimatePose(images, prior, result);
    }
    if (estimate) {
      updateMap(images, prior, *estimate, result);
    } else {
      handleLoss(images, result);
    }
  }
  result.T_start_camera = T_camera_world_.inverse();
  result.keyframe_id = keyframe_id_;
  reportTimes(images.times, matcher_.stampError(), result);
  reportTracks(follower_.tracks(), motion_.previousView().T_camera_world, result);
  if (result.keyframe) reportKeyframe(follower_.tracks(), map_, calibration_, result);
  return result;
}

std::optional<PoseEstimate> StereoOdometry::estimatePose(const StereoImages& images, const MotionPrior& prior,
                                                         FrameResult& result) {
  StageClock clock(result.stage_times);
  const vision::StereoView predicted = prior.predictedView();
  row_twist_ = prior.twistAt(predicted);
  follower_.updatePoints(map_);
  follower_.follow(images.left, prediction(predicted), prior.predictsMotion());
  selectReliableTracks(params_.min_inliers, follower_.tracks());
  clock.lap("track");
  const vision::StereoView guess = matchRightImage(images, prior, predicted);
  clock.lap("stereo");
  const TrackIndices rigid = selectRigid(prior, guess, result);
  clock.lap("select");
  PoseEstimate estimate = estimateRobustly(rigid, prior, guess);
  if (estimate.converged && hasFewInliers(estimate) && recoverTracks(images, estimate.view))
    estimate = estimateRobustly(foundTracks(follower_.tracks()), prior, estimate.view);
  if (exceedsAcceleration(estimate, prior)) {
    mover_fills_view_ = true;
    compensateRows(prior, predicted);  // the rows did not move along with the mover
    estimate =
        estimateRobustly(tracksNear(calibration_, predicted, params_.motion.max_error_px, follower_.tracks()),
                         prior, predicted);
  }
  if (start_needs_compensation_ && hasEnoughInliers(estimate)) {
    compensateStart(prior.twistAt(estimate.view));
    estimate = estimateRobustly(foundTracks(follower_.tracks()), prior, estimate.view);
  }
  clock.lap("estimate");
  if (isAcceptable(estimate, prior, images.times, result)) return estimate;
  for (Track& track : follower_.tracks()) track.inlier = false;
  return std::nullopt;
}

vision::StereoView StereoOdometry::matchRightImage(const StereoImages& images, const MotionPrior& prior,
                                                   const vision::StereoView& predicted) {
  std::vector<Track>& tracks = follower_.tracks();
  if (prior.right_time_offset_s == 0.0) {
    matcher_.match(images, predicted, 0.0, tracks);
    compensateRows(prior, predicted);
    return predicted;
  }
  // Epipolar lines bend with the motion between the stamps, as far as the left image alone tells it.
  for (Track& track : tracks) track.in_image.has_right = false;
  compensateRows(prior, predicted);
  const PoseEstimate by_left = estimateFrom(foundTracks(tracks), prior, predicted);
  const vision::StereoView& view = by_left.converged ? by_left.view : predicted;
  matcher_.match(images, view, matcher_.slack_px(prior.lateSigma()), tracks);
  compensateRows(prior, view);
  // Depths have to be freed from that motion before they can be judged.
  const PoseEstimate by_both = estimateFrom(foundTracks(tracks), prior, view);
  return by_both.converged ? by_both.view : view;
}

TrackIndices StereoOdometry::selectRigid(const MotionPrior& prior, const vision::StereoView& view,
                                         FrameResult& result) const {
  const RigidSelection rigid = selectRigidTracks(params_.clique, params_.rigidity, calibration_,
                                                 prior.T_previous_world, view, follower_.tracks());
  TrackIndices found = foundTracks(follower_.tracks());
  result.features_tracked = static_cast<std::uint32_t>(found.size());
  result.features_with_depth = static_cast<std::uint32_t>(rigid.with_depth);
  result.clique_size = static_cast<std::uint32_t>(rigid.tracks.size());
  return rigid.tracks.size() < static_cast<std::size_t>(params_.min_inliers) ? found : rigid.tracks;
}

PoseEstimate StereoOdometry::estimateFrom(const TrackIndices& selected, const MotionPrior& prior,
                                          const vision::StereoView& guess) const {
  return estimator_.estimate(observations(follower_.tracks(), selected), prior, guess);
}

PoseEstimate StereoOdometry::estimateRobustly(const TrackIndices& selected, const MotionPrior& prior,
                                              const vision::StereoView& guess) {
  compensateRows(prior, guess);
  PoseEstimate by_selected = estimateFrom(selected, prior, guess);
  if (!by_selected.converged) return by_selected;
  compensateRows(prior, by_selected.view);
  // Tracks without a depth of their own in this frame take part, too.
  const TrackIndices found = foundTracks(follower_.tracks());
  PoseEstimate estimate = estimateFrom(found, prior, by_selected.view);
  for (std::size_t k = 0; k < found.size(); ++k) follower_.tracks()[found[k]].inlier = estimate.inlier[k];
  return estimate;
}

bool StereoOdometry::hasEnoughInliers(const PoseEstimate& estimate) const {
  return estimate.converged && estimate.inliers >= static_cast<std::size_t>(params_.min_inliers);
}

bool StereoOdometry::hasFewInliers(const PoseEstimate& estimate) const {
  return static_cast<double>(estimate.inliers) <
         kStrongShare * static_cast<double>(aliveTracks(follower_.tracks()));
}

bool StereoOdometry::exceedsAcceleration(const PoseEstimate& estimate, const MotionPrior& prior) const {
  return hasEnoughInliers(estimate) &&
         motion_.exceedsAcceleration(estimate.view.T_camera_world * prior.T_previous_world.inverse(),
                                     prior.interval_s);
}

bool StereoOdometry::isAmbiguous(const Consensus& consensus) const {
  if (!isConfirmed() && restsOnFew(consensus, estimator_, params_.motion.max_error_px)) return true;
  return !consensus.is_expected &&
         hasRival(consensus, params_.clique, params_.rigidity, estimator_, params_.motion.max_error_px);
}

bool StereoOdometry::isAcceptable(const PoseEstimate& estimate, const MotionPrior& prior,
                                  const FrameTimes& times, FrameResult& result) const {
  if (!hasEnoughInliers(estimate)) {
    result.reason = tooFewInliers(estimate.inliers, result.features_tracked, params_.min_inliers);
    return false;
  }
  const Consensus consensus{
      calibration_, follower_.tracks(), prior, estimate,
      motion_.expects(estimate.view.T_camera_world, estimate.covariance, times, params_.coasting_s)};
  result.reason = doubtAbout(consensus);
  if (result.reason.empty() && isAmbiguous(consensus)) result.reason = ambiguous();
  if (result.reason.empty() && exceedsAcceleration(estimate, prior)) result.reason = moverFillsView();
  if (result.reason.empty() && confirmations_ == 1)
    result.reason = doubtAboutStart(follower_.tracks(), params_.min_inliers);
  return result.reason.empty();
}

bool StereoOdometry::recoverTracks(const StereoImages& images, const vision::StereoView& view) {
  const TrackIndices recovered = follower_.recover(images.left, prediction(view));
  for (const std::size_t i : recovered) matcher_.match(images, view, 0.0, follower_.tracks()[i]);
  selectReliableTracks(params_.min_inliers, follower_.tracks());
  return !recovered.empty();
}

FramePrediction StereoOdometry::prediction(const vision::StereoView& view) const {
  return {calibration_, shutter_, view, row_twist_, map_.newest().view.T_camera_world};
}

void StereoOdometry::compensateRows(const MotionPrior& prior, const vision::StereoView& view) {
  row_twist_ = prior.twistAt(view);
  compensateRollingShutter(shutter_, view, row_twist_, follower_.tracks());
}

void StereoOdometry::compensateStart(const Vector6d& twist) {
  start_needs_compensation_ = false;
  for (Landmark& landmark : map_.landmarks()) {
    placeAtStamp(calibration_, shutter_, map_.oldest().view, twist, landmark, landmark.views.front().seen);
  }
  follower_.updatePoints(map_);
}

void StereoOdometry::updateMap(const StereoImages& images, const MotionPrior& prior,
                               const PoseEstimate& estimate, FrameResult& result) {
  StageClock clock(result.stage_times);
  map_.addFrame(MotionModel::windowFrame(estimate.view, prior));
  if (previous_is_keyframe_ && lost_frames_ == 0)
    motion_.smoothTimeOffset(images.times, map_.newest().view, map_.beforeNewest());
  for (const Track& track : follower_.tracks()) {
    if (track.inlier) map_.addObservation(track.landmark_id, track.at_stamp);
  }
  map_.refine();
  follower_.updatePoints(map_);
  const vision::StereoView view = map_.newest().view;
  matcher_.learn(view, prior, follower_.tracks());
  clock.lap("window");

  result.T_previous_current = prior.T_previous_world * view.T_camera_world.inverse();
  if (prior.R_current_previous) {
    result.rotation_disagreement_rad =
        logRotation(*prior.R_current_previous * result.T_previous_current.linear()).norm();
  }
  motion_.update(images.times, prior, view, estimate.covariance);
  T_camera_world_ = view.T_camera_world;
  if (!isConfirmed()) ++confirmations_;
  result.state = isConfirmed() ? State::kTracking : State::kInitialising;
  if (isConfirmed()) motion_.trustPrevious();
  if (!isConfirmed()) result.reason = unconfirmed();
  const double variance_px2 = kDependence * estimate.variance_px2;
  result.pose_noise = variance_px2 * map_.noise().value_or(estimate.covariance / estimate.variance_px2);
  result.calibration_effects = effects_.of(follower_.tracks(), estimate, result.T_previous_current);
  result.reprojection_error_px = estimate.rms_px;
  lost_frames_ = 0;
  previous_is_keyframe_ = needsKeyframe(params_.keyframes, follower_.tracks(), keyframe_features_);
  if (previous_is_keyframe_) {
    result.motion_covariance =
        variance_px2 * map_.growth().value_or(Matrix6d::Zero()) + kDependence * estimate.covariance;
    makeKeyframe(images, result);
  } else {
    map_.removeNewest();
  }
  clock.lap("keyframe");
}

void StereoOdometry::startMap(const StereoImages& images, const Eigen::Isometry3d& T_camera_world,
                              FrameResult& result) {
  StageClock clock(result.stage_times);
  map_.start(motion_.start(images.times, T_camera_world));
  confirmations_ = 0;
  follower_.reset();
  row_twist_.setZero();
  mover_fills_view_ = false;
  start_needs_compensation_ = !shutter_.isGlobal();
  makeKeyframe(images, result);
  previous_is_keyframe_ = true;
  if (map_.landmarks().size() < static_cast<std::size_t>(params_.min_inliers)) {
    result.keyframe = false;
    result.reason = tooFewLandmarks(map_.landmarks().size(), params_.min_inliers);
    map_.clear();
    return;
  }
  clock.lap("start");
}

void StereoOdometry::makeKeyframe(const StereoImages& images, FrameResult& result) {
  follower_.startKeyframe(images.left);
  addLandmarks(images, result);
  keyframe_features_ = aliveTracks(follower_.tracks());
  ++keyframe_id_;
  result.keyframe = true;
  map_.keepNewest();
  std::vector<std::uint64_t> followed;
  for (const Track& track : follower_.tracks()) {
    if (track.alive) followed.push_back(track.landmark_id);
  }
  map_.removeUnused(followed);
  follower_.removeTracksWithout(map_);
}

void StereoOdometry::addLandmarks(const StereoImages& images, FrameResult& result) {
  const WindowFrame& frame = map_.newest();
  // At the very start nothing is known of the motion between the stamps.
  const bool is_vague = map_.isAtStart() && frame.has_time_offset;
  const double slack_px = is_vague ? matcher_.slack_px(frame.late_sigma) : 0.0;
  LandmarkDetector::Result found =
      detector_.detect({images, shutter_, frame.view, row_twist_, slack_px}, follower_.tracks(), matcher_);
  result.features_detected = static_cast<std::uint32_t>(found.corners);
  if (map_.isAtStart() && !frame.has_time_offset) matcher_.learnRowsAtStart(found.landmarks);
  for (const NewLandmark& detected : found.landmarks) {
    Track track;
    track.landmark_id = map_.addLandmark(detected.landmark, detected.at_stamp);
    track.p_world = detected.landmark.p_world();
    track.keyframe_px = track.previous_px = detected.in_image.left_px;
    track.in_image = detected.in_image;
    track.at_stamp = detected.at_stamp;
    track.found = track.inlier = true;
    follower_.add(track);
  }
}

bool StereoOdometry::coast(const FrameTimes& times, FrameResult& result) {
  const Coasted coasted = motion_.coasted(times, params_.coasting_s);
  result.T_previous_current = T_camera_world_ * coasted.T_camera_world.inverse();
  result.motion_covariance = coasted.covariance;
  result.turn_is_measured = coasted.turn_is_measured;
  T_camera_world_ = coasted.T_camera_world;
  return coasted.velocity_is_known;
}

void StereoOdometry::startMapCoasting(const StereoImages& images, FrameResult& result) {
  const bool is_moving = coast(images.times, result);
  const StereoOdometry before = *this;
  startMap(images, T_camera_world_, result);
  if (result.keyframe) {
    result.new_map = result.state != State::kInitialising;
  } else if (!before.map_.empty()) {  // an old map is worth more than none
    *this = before;
    if (is_moving) result.state = State::kCoasting;
  }
}

void StereoOdometry::handleLoss(const StereoImages& images, FrameResult& result) {
  constexpr double kPatience_s = 1.0;  // for what fills the view and may pass
  const double lost_for_s = images.times.left_s - motion_.previousTimes().left_s;
  const std::size_t corners = detector_.countCorners(images.left);
  const bool is_blank = corners < static_cast<std::size_t>(params_.min_inliers);
  if (is_blank) {
    result.reason = blankImage(corners);
  } else if (!(mover_fills_view_ && lost_for_s < kPatience_s)) {
    ++lost_frames_;
  }
  result.state = State::kLost;  // and what has not been confirmed is not worth waiting for
  if (lost_frames_ > params_.max_lost_frames || (!is_blank && !isConfirmed())) {
    startMapCoasting(images, result);
  } else if (coast(images.times, result)) {
    result.state = State::kCoasting;
  }
}

}  // namespace stereo_nav::odometry
