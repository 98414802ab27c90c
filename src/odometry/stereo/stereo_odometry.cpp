#include "odometry/stereo/stereo_odometry.h"

#include <cmath>
#include <sstream>

#include "odometry/common/stage_clock.h"
#include "stereo_nav/core/parameters.h"
#include "vision/pixel.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kNegligibleSkew_s = 1e-5;
/// m/s and rad/s: how fast the rig may move before anything is known of it.
constexpr double kFirstTwistSigma = 1.0;

}  // namespace

StereoOdometry::StereoOdometry(const StereoParams& params, const vision::StereoCalibration& calibration,
                               const Eigen::Matrix3d& R_camera_imu)
    : params_(params),
      calibration_(calibration),
      detector_(params.corners, cv::Size(calibration.width, calibration.height)),
      tracker_(params.tracking),
      stereo_(params.stereo, calibration),
      estimator_(params.motion, calibration),
      optimizer_(params.window, calibration),
      imu_(params.imu, R_camera_imu),
      shutter_(calibration) {
  validateParameters(params, "stereo");
  calibration.validate();
}

void StereoOdometry::reset() {
  detector_.reset();
  imu_.reset();
  window_.clear();
  landmarks_.clear();
  tracks_.clear();
  keyframe_image_ = vision::ImagePyramid();
  keyframe_inliers_ = 0;
  keyframe_id_ = 0;
  last_view_ = vision::StereoView();
  twist_.reset();
  failures_ = 0;
  movers_fill_view_ = false;
  stereo_.epipolarError().reset();
}

FrameResult StereoOdometry::process(const StereoFrame& frame) {
  checkFrame(frame);
  FrameResult result;
  StageClock clock(result.stage_times);
  Images images;
  images.left = vision::ImagePyramid(frame.left, params_.pyramid_levels);
  images.right = vision::ImagePyramid(frame.right, params_.pyramid_levels);
  images.left_time_s = frame.left_time_s;
  images.right_time_s = frame.right_time_s;
  if (std::abs(images.skew_s()) < kNegligibleSkew_s) images.right_time_s = images.left_time_s;
  shutter_.setReadout(frame.readout_s);
  clock.lap("pyramid");

  if (window_.empty()) {
    result.state = keyframe_id_ == 0 ? State::kInitialising : State::kLost;
    result.reason = "first frame: nothing to measure motion against yet";
    startAt(images, last_view_.T_camera_world, result);
  } else if (!followOrSearch(images, result)) {
    result.state = State::kLost;
    if (!isBlank(images, result) && !waitsForMovers(images)) ++failures_;
    if (failures_ > params_.max_coasting_frames) startAt(images, turnedSinceLast(images), result);
  }
  result.T_start_camera = last_view_.T_camera_world.inverse();
  result.keyframe_id = keyframe_id_;
  result.skew_compensated = images.skew_s() != 0.0;
  report(result);
  return result;
}

void StereoOdometry::startAt(const Images& images, const Eigen::Isometry3d& T_camera_world,
                             FrameResult& result) {
  StageClock clock(result.stage_times);
  landmarks_.clear();
  tracks_.clear();
  window_.assign(1, WindowFrame());
  WindowFrame& first = window_.back();
  first.view.T_camera_world = T_camera_world;
  first.skewed = images.skew_s() != 0.0;
  first.late_sigma.setConstant(kFirstTwistSigma * std::abs(images.skew_s()));
  twist_.reset();
  row_twist_.setZero();
  movers_fill_view_ = false;
  last_left_time_s_ = images.left_time_s;
  last_skew_s_ = images.skew_s();
  last_interval_s_ = 0.0;
  if (const auto late = imu_.increment(images.left_time_s, images.right_time_s)) {
    first.view.T_late_camera.linear() = first.T_late_expected.linear() = late->R_to_from;
    first.late_sigma.tail<3>().setConstant(late->sigma_rad);
  }
  last_view_ = first.view;
  makeKeyframe(images, result);
  start_is_bent_ = !shutter_.isGlobal();
  learnEpipolarErrorAtStart();
  last_is_keyframe_ = true;
  if (landmarks_.size() < static_cast<std::size_t>(params_.min_inliers)) {
    window_.clear();
    result.keyframe = false;
    std::ostringstream message;
    message << "only " << landmarks_.size() << " features with depth, " << params_.min_inliers
            << " needed: dark, blocked or without texture; or the cameras are not those of the calibration";
    result.reason = message.str();
    return;
  }
  clock.lap("start");
}

bool StereoOdometry::followOrSearch(const Images& images, FrameResult& result) {
  if (follow(images, result)) return true;
  if (!twist_) return false;
  // A sudden stop, or a gap in the images: the velocity may have been what led astray.
  twist_.reset();
  return follow(images, result);
}

Eigen::Isometry3d StereoOdometry::turnedSinceLast(const Images& images) const {
  Eigen::Isometry3d T_camera_last = Eigen::Isometry3d::Identity();
  if (const auto turn = imu_.increment(last_left_time_s_, images.left_time_s)) {
    T_camera_last.linear() = turn->R_to_from;
  }
  return T_camera_last * last_view_.T_camera_world;
}

bool StereoOdometry::isBlank(const Images& images, FrameResult& result) {
  const std::size_t corners = detector_.detect(images.left.level(0), {}).size();
  if (corners >= static_cast<std::size_t>(params_.min_inliers)) return false;
  std::ostringstream message;
  message << "the left image is blank, " << corners
          << " corners: dark, covered, or overexposed; the features seen before are waited for";
  result.reason = message.str();
  return true;
}

bool StereoOdometry::follow(const Images& images, FrameResult& result) {
  StageClock clock(result.stage_times);
  const MotionPrior prior = motionPrior(images);
  const vision::StereoView predicted = predict(images, prior);
  row_twist_ = twistAt(predicted, prior);
  trackAll(images, predicted, twist_ || prior.R_camera_previous);
  clock.lap("track");
  vision::StereoView guess = predicted;
  if (images.skew_s() == 0.0) {
    matchStereo(images, guess, 0.0);
    straighten(guess, prior);
  } else {
    guess = leftOnlyView(prior, predicted);
    matchStereo(images, guess, epipolarSlack(prior.lateSigma()));
    straighten(guess, prior);
    // Depth has to be freed from the motion between the stamps before it can be judged.
    const PoseEstimate rough = estimateFrom(foundTracks(), prior, guess);
    if (rough.converged) guess = rough.view;
  }
  clock.lap("stereo");
  const std::vector<std::size_t> selected = selectRigid(guess, result);
  clock.lap("select");
  PoseEstimate estimate = estimatePose(selected, prior, guess);
  if (estimate.converged && isThin(estimate) && recover(images, estimate.view) > 0) {
    estimate = estimatePose(foundTracks(), prior, estimate.view);
  }
  if (isCarriedAway(estimate, prior)) {
    movers_fill_view_ = true;
    straighten(predicted, prior);  // not along the motion of what carried it away
    estimate = estimatePose(tracksNear(predicted), prior, predicted);
  }
  if (start_is_bent_ && hasEnoughInliers(estimate)) {
    straightenStart(twistAt(estimate.view, prior));
    estimate = estimatePose(foundTracks(), prior, estimate.view);
  }
  clock.lap("estimate");
  if (!isAcceptable(estimate, prior, result)) return false;
  if (failures_ > 0) last_is_keyframe_ = false;
  failures_ = 0;
  const Eigen::Isometry3d T_world_last = last_view_.T_camera_world.inverse();
  window_.emplace_back();
  window_.back().view = estimate.view;
  expectSkew(images, prior);
  smoothPreviousSkew(images);
  refineWindow();
  learnEpipolarError();
  clock.lap("window");
  const Eigen::Isometry3d T_camera_last = window_.back().view.T_camera_world * T_world_last;
  if (prior.R_camera_previous) {
    result.rotation_disagreement_rad =
        logRotation(*prior.R_camera_previous * T_camera_last.linear().transpose()).norm();
    imu_.learn(last_left_time_s_, images.left_time_s, T_camera_last.linear(),
               std::sqrt(estimate.covariance.bottomRightCorner<3, 3>().trace() / 3.0));
  }
  updateTwist(images, prior);
  result.state = State::kTracking;
  result.T_previous_camera = T_camera_last.inverse();
  result.motion_covariance = estimate.covariance;
  result.reprojection_error_px = estimate.rms_px;
  last_view_ = window_.back().view;
  last_left_time_s_ = images.left_time_s;
  last_skew_s_ = images.skew_s();
  last_is_keyframe_ = needsKeyframe();
  if (last_is_keyframe_) {
    makeKeyframe(images, result);
  } else {
    for (Landmark& landmark : landmarks_) {
      if (!landmark.views.empty() && landmark.views.back().frame + 1 == static_cast<int>(window_.size()))
        landmark.views.pop_back();
    }
    window_.pop_back();
  }
  clock.lap("keyframe");
  return true;
}

bool StereoOdometry::isAcceptable(const PoseEstimate& estimate, const MotionPrior& prior,
                                  FrameResult& result) {
  const bool carried_away = isCarriedAway(estimate, prior);
  if (!carried_away && hasEnoughInliers(estimate)) return true;
  for (Track& track : tracks_) track.inlier = false;
  if (carried_away) {
    result.reason =
        "most of what is seen moves as no robot could have begun to within a frame: something that moves on "
        "its own fills the view; the features seen before are waited for";
    return false;
  }
  std::ostringstream message;
  message << "only " << estimate.inliers << " of " << result.features_tracked
          << " tracked features agree with one motion, " << params_.min_inliers
          << " needed: dark, blocked, without texture, moved too far, or moving objects fill the view";
  result.reason = message.str();
  return false;
}

}  // namespace stereo_nav::odometry
