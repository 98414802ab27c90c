#include "stereo_nav/vo/stereo_odometry.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "stage_clock.h"
#include "stereo_nav/params/parameters.h"
#include "stereo_nav/vo/exact_clique.h"
#include "stereo_nav/vo/image_shift.h"

namespace stereo_nav::vo {
namespace {

constexpr double kNegligibleSkew_s = 1e-5;
/// m/s and rad/s: how fast the rig may move before anything is known of it.
constexpr double kFirstTwistSigma = 1.0;

void checkImages(const StereoFrame& frame, const StereoCalibration& calibration) {
  const cv::Size expected(calibration.width, calibration.height);
  for (const cv::Mat* image : {&frame.left, &frame.right}) {
    if (image->type() == CV_8UC1 && image->size() == expected) continue;
    std::ostringstream message;
    message << (image == &frame.left ? "left" : "right") << " image is " << image->cols << "x" << image->rows
            << " of OpenCV type " << image->type() << ", calibration is for " << expected.width << "x"
            << expected.height << " of 8 bit grey: is camera_info of another resolution than the images?";
    throw std::invalid_argument(message.str());
  }
}

cv::Point2f toCv(const Eigen::Vector2d& px) {
  return {static_cast<float>(px.x()), static_cast<float>(px.y())};
}

Eigen::Vector2d toEigen(const cv::Point2f& px) {
  return {static_cast<double>(px.x), static_cast<double>(px.y)};
}

/// How well the motion between the stamps is known before the right image is looked at.
Vector6d lateSigma(const MotionPrior& prior) {
  Vector6d sigma = prior.twist_sigma * std::abs(prior.skew_s);
  if (prior.R_late_camera) sigma.tail<3>().setConstant(prior.rotation_sigma_rad);
  return sigma;
}

/// The motion over `time_s` of a camera that moves by `after` in `after_s` and moved by the inverse of
/// `before` in the `before_s` up to now: the parabola of twists through the three poses.
Eigen::Isometry3d interpolatedMotion(const Eigen::Isometry3d& T_next_now, double after_s,
                                     const Eigen::Isometry3d& T_now_before, double before_s, double time_s) {
  const Vector6d rate_after = logMotion(T_next_now) / after_s;
  const Vector6d rate_before = logMotion(T_now_before) / before_s;
  const Vector6d curvature = (rate_after - rate_before) / (after_s + before_s);
  const Vector6d rate = rate_after - curvature * after_s;
  return expMotion(rate * time_s + curvature * time_s * time_s);
}

}  // namespace

void KeyframeParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window", window, {2, 50}, "", "keyframes refined together");
  visitor.real("min_tracked_share", min_tracked_share, {0.0, 1.0}, "",
               "a frame with a smaller share of the last keyframe's inliers becomes a keyframe");
  visitor.real("max_parallax_px", max_parallax_px, {0.1, 1000.0}, "px",
               "a frame whose features have moved further since the last keyframe (median) becomes one");
}

void StereoParams::describe(ParameterVisitor& visitor) {
  visitor.integer("pyramid_levels", pyramid_levels, {1, 8}, "", "image sizes, each half the one before");
  visitSection(visitor, "corners", corners);
  visitSection(visitor, "tracking", tracking);
  visitSection(visitor, "stereo", stereo);
  visitSection(visitor, "rigidity", rigidity);
  visitor.integer("clique_budget", clique_budget, {0, 10000000}, "",
                  "most nodes expanded in search of the largest rigid set");
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "window", window);
  visitSection(visitor, "keyframes", keyframes);
  visitSection(visitor, "imu", imu);
  visitor.integer("min_inliers", min_inliers, {4, 1000}, "",
                  "fewer features that agree are no motion: the frame is lost");
  visitor.integer("max_coasting_frames", max_coasting_frames, {0, 1000}, "",
                  "lost frames after which the map is given up and a new one begun");
  visitor.real("acceleration_density", acceleration_density, {1e-6, 1e6}, "m^2/s^3",
               "how much the velocity changes: its variance grows by this per second");
  visitor.real("angular_acceleration_density", angular_acceleration_density, {1e-6, 1e6}, "rad^2/s^3",
               "how much the angular rate changes: its variance grows by this per second");
}

StereoOdometry::StereoOdometry(const StereoParams& params, const StereoCalibration& calibration,
                               const Eigen::Matrix3d& R_camera_imu)
    : params_(params),
      calibration_(calibration),
      detector_(params.corners, cv::Size(calibration.width, calibration.height)),
      tracker_(params.tracking),
      stereo_(params.stereo, calibration),
      estimator_(params.motion, calibration),
      optimizer_(params.window, calibration),
      imu_(params.imu, R_camera_imu) {
  validateParameters(params, "stereo");
  calibration.validate();
}

void StereoOdometry::reset() {
  detector_.reset();
  imu_.reset();
  window_.clear();
  landmarks_.clear();
  tracks_.clear();
  keyframe_image_ = ImagePyramid();
  keyframe_inliers_ = 0;
  keyframe_id_ = 0;
  last_view_ = StereoView();
  twist_.reset();
  failures_ = 0;
}

FrameResult StereoOdometry::process(const StereoFrame& frame) {
  checkImages(frame, calibration_);
  FrameResult result;
  StageClock clock(result.stage_times);
  Images images;
  images.left = ImagePyramid(frame.left, params_.pyramid_levels);
  images.right = ImagePyramid(frame.right, params_.pyramid_levels);
  images.left_time_s = frame.left_time_s;
  images.right_time_s = frame.right_time_s;
  if (std::abs(images.skew_s()) < kNegligibleSkew_s) images.right_time_s = images.left_time_s;
  clock.lap("pyramid");

  if (window_.empty()) {
    result.state = keyframe_id_ == 0 ? State::kInitialising : State::kLost;
    result.reason = "first frame: nothing to measure motion against yet";
    startAt(images, last_view_.T_camera_world, result);
  } else if (!followOrSearch(images, result)) {
    result.state = State::kLost;
    if (!isBlank(images, result)) ++failures_;
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
  last_left_time_s_ = images.left_time_s;
  last_skew_s_ = images.skew_s();
  last_interval_s_ = 0.0;
  if (const auto late = imu_.increment(images.left_time_s, images.right_time_s)) {
    first.view.T_late_camera.linear() = first.T_late_expected.linear() = late->R_to_from;
    first.late_sigma.tail<3>().setConstant(late->sigma_rad);
  }
  last_view_ = first.view;
  makeKeyframe(images, result);
  last_is_keyframe_ = true;
  if (landmarks_.size() < static_cast<std::size_t>(params_.min_inliers)) {
    window_.clear();
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
  const StereoView predicted = predict(images, prior);
  trackAll(images, predicted);
  clock.lap("track");
  StereoView guess = predicted;
  if (images.skew_s() == 0.0) {
    matchStereo(images, guess, 0.0);
  } else {
    guess = leftOnlyView(prior, predicted);
    matchStereo(images, guess, epipolarSlack(lateSigma(prior)));
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
  clock.lap("estimate");
  if (!estimate.converged || estimate.inliers < static_cast<std::size_t>(params_.min_inliers)) {
    std::ostringstream message;
    message << "only " << estimate.inliers << " of " << result.features_tracked
            << " tracked features agree with one motion, " << params_.min_inliers
            << " needed: dark, blocked, without texture, moved too far, or moving objects fill the view";
    result.reason = message.str();
    return false;
  }
  if (failures_ > 0) last_is_keyframe_ = false;
  failures_ = 0;
  const Eigen::Isometry3d T_world_last = last_view_.T_camera_world.inverse();
  window_.emplace_back();
  window_.back().view = estimate.view;
  expectSkew(images, prior);
  smoothPreviousSkew(images);
  refineWindow();
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

MotionPrior StereoOdometry::motionPrior(const Images& images) const {
  MotionPrior prior;
  prior.T_previous_world = last_view_.T_camera_world;
  prior.interval_s = images.left_time_s - last_left_time_s_;
  prior.skew_s = images.skew_s();
  prior.previous_twist = twist_;
  const double spread = twist_ ? 0.5 * std::sqrt(prior.interval_s) : std::sqrt(prior.interval_s);
  prior.twist_sigma.head<3>().setConstant(std::sqrt(params_.acceleration_density) * spread);
  prior.twist_sigma.tail<3>().setConstant(std::sqrt(params_.angular_acceleration_density) * spread);
  if (const auto turn = imu_.increment(last_left_time_s_, images.left_time_s)) {
    prior.R_camera_previous = turn->R_to_from;
    prior.rotation_sigma_rad = turn->sigma_rad;
  }
  if (const auto late = imu_.increment(images.left_time_s, images.right_time_s)) {
    prior.R_late_camera = late->R_to_from;
  }
  return prior;
}

StereoView StereoOdometry::predict(const Images& images, const MotionPrior& prior) const {
  const Vector6d twist = twist_.value_or(Vector6d::Zero());
  Eigen::Isometry3d T_camera_previous = expMotion(twist * prior.interval_s);
  StereoView view;
  view.T_late_camera = expMotion(twist * images.skew_s());
  if (prior.R_camera_previous) T_camera_previous.linear() = *prior.R_camera_previous;
  if (prior.R_late_camera) view.T_late_camera.linear() = *prior.R_late_camera;
  view.T_camera_world = T_camera_previous * prior.T_previous_world;
  return view;
}

Eigen::Vector2d StereoOdometry::predictedPixel(std::size_t i, const StereoView& view) const {
  const Eigen::Vector3d p = view.T_camera_world * landmarks_[i].p_world();
  return p.z() < kNearestDepth_m ? tracks_[i].last_px : projectLeft(calibration_, p);
}

Eigen::Matrix2f StereoOdometry::patchStep(std::size_t i, const StereoView& view) const {
  // The keyframe is the last of the window as long as the current frame has no pose.
  const Eigen::Isometry3d T_keyframe_camera =
      window_.back().view.T_camera_world * view.T_camera_world.inverse();
  const Eigen::Vector3d p_world = landmarks_[i].p_world();
  const double zoom =
      (view.T_camera_world * p_world).z() / (window_.back().view.T_camera_world * p_world).z();
  if (!(zoom > 0.5 && zoom < 2.0)) return Eigen::Matrix2f::Identity();
  const Eigen::Matrix3d& R = T_keyframe_camera.linear();
  const double roll = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  return (zoom * Eigen::Rotation2Dd(roll).toRotationMatrix()).cast<float>();
}

bool StereoOdometry::trackOne(const Images& images, std::size_t i, const Eigen::Vector2d& guess_px,
                              int top_level, const Eigen::Matrix2f& step, int finest_level) {
  Track& track = tracks_[i];
  const auto match = tracker_.track(keyframe_image_, toCv(track.keyframe_px), images.left, toCv(guess_px),
                                    top_level, step, finest_level);
  track.found = match.has_value();
  if (!match) return false;
  track.seen.left_px = toEigen(match->px);
  track.seen.noise = 1 << finest_level;
  return true;
}

void StereoOdometry::trackAll(const Images& images, const StereoView& predicted) {
  const int coarsest = params_.pyramid_levels - 1;
  const bool expected = twist_ || imu_.increment(last_left_time_s_, images.left_time_s);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (track.inlier) {
      track.last_px = track.seen.left_px;
      ++track.confirmations;
    }
    track.fresh = false;
    track.inlier = false;
    track.found = false;
    if (!track.alive) continue;
    if (expected &&
        trackOne(images, i, predictedPixel(i, predicted), std::min(2, coarsest), patchStep(i, predicted), 0))
      continue;
    trackOne(images, i, track.last_px, coarsest, Eigen::Matrix2f::Identity(), 0);
  }
  if (lostMany()) trackAfterTurn(images);
  if (lostMany()) trackBlurred(images, predicted);
  appointVoters();
}

bool StereoOdometry::lostMany() const {
  constexpr double kShare = 0.5;
  std::size_t alive = 0;
  std::size_t found = 0;
  for (const Track& track : tracks_) {
    if (track.alive) ++alive;
    if (track.found) ++found;
  }
  return static_cast<double>(found) < kShare * static_cast<double>(alive);
}

void StereoOdometry::trackAfterTurn(const Images& images) {
  const auto shift = coarseShift(keyframe_image_, images.left);
  if (!shift) return;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].found) continue;
    trackOne(images, i, tracks_[i].keyframe_px + toEigen(*shift), params_.pyramid_levels - 1,
             Eigen::Matrix2f::Identity(), 0);
  }
}

void StereoOdometry::trackBlurred(const Images& images, const StereoView& predicted) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].found) continue;
    trackOne(images, i, twist_ ? predictedPixel(i, predicted) : tracks_[i].last_px,
             params_.pyramid_levels - 1, patchStep(i, predicted), 1);
  }
}

StereoView StereoOdometry::leftOnlyView(const MotionPrior& prior, const StereoView& predicted) {
  for (Track& track : tracks_) track.seen.has_right = false;
  const PoseEstimate estimate = estimateFrom(foundTracks(), prior, predicted);
  return estimate.converged ? estimate.view : predicted;
}

double StereoOdometry::epipolarSlack(const Vector6d& late_sigma) const {
  constexpr double kNearDepth_m = 3.0;
  return calibration_.fx * (late_sigma.tail<3>().maxCoeff() + late_sigma.head<3>().maxCoeff() / kNearDepth_m);
}

bool StereoOdometry::isThin(const PoseEstimate& estimate) const {
  constexpr double kThinShare = 0.6;
  const auto alive =
      std::count_if(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.alive; });
  return static_cast<double>(estimate.inliers) < kThinShare * static_cast<double>(alive);
}

std::size_t StereoOdometry::recover(const Images& images, const StereoView& view) {
  std::size_t recovered = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].alive || tracks_[i].inlier) continue;
    if (!trackOne(images, i, predictedPixel(i, view), 1, patchStep(i, view), 0)) continue;
    matchStereoOne(images, i, view, 0.0);
    ++recovered;
  }
  appointVoters();
  return recovered;
}

void StereoOdometry::matchStereo(const Images& images, const StereoView& view, double slack_px) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].found) matchStereoOne(images, i, view, slack_px);
  }
}

void StereoOdometry::matchStereoOne(const Images& images, std::size_t i, const StereoView& view,
                                    double slack_px) {
  Track& track = tracks_[i];
  track.seen.has_right = false;
  // Seen from where the feature is, not from where the map expects it.
  const double depth_m = (view.T_camera_world * landmarks_[i].p_world()).z();
  if (depth_m < kNearestDepth_m) return;
  const Eigen::Vector2d guess =
      transferToRight(calibration_, view.T_late_camera, track.seen.left_px, 1.0 / depth_m);
  const auto match =
      stereo_.refine(images.left, images.right, view.T_late_camera, track.seen.left_px, guess, slack_px);
  if (!match) return;
  track.seen.right_px = match->right_px;
  track.seen.has_right = true;
}

std::vector<std::size_t> StereoOdometry::foundTracks() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].found) found.push_back(i);
  }
  return found;
}

void StereoOdometry::appointVoters() {
  constexpr int kConfirmations = 3;
  const int enough = params_.min_inliers + params_.min_inliers / 2;
  int required = kConfirmations;
  const auto proven = [&required](const Track& track) {
    return track.found && track.confirmations >= required;
  };
  while (required > 0 && std::count_if(tracks_.begin(), tracks_.end(), proven) < enough) --required;
  for (Track& track : tracks_) track.votes = proven(track);
}

std::vector<std::size_t> StereoOdometry::selectRigid(const StereoView& view, FrameResult& result) const {
  const std::vector<std::size_t> found = foundTracks();
  std::vector<std::size_t> with_depth;
  std::vector<RigidPoint> points;
  for (const std::size_t i : found) {
    const StereoObservation& seen = tracks_[i].seen;
    if (!seen.has_right || !tracks_[i].votes) continue;
    const Triangulation depth = triangulate(calibration_, view.T_late_camera, seen.left_px, seen.right_px);
    if (depth.inverse_depth <= 0.0) continue;
    with_depth.push_back(i);
    points.push_back({last_view_.T_camera_world * landmarks_[i].p_world(),
                      leftRay(calibration_, seen.left_px) / depth.inverse_depth});
  }
  const CliqueResult clique = largestClique(buildNoisyRigidityGraph(params_.rigidity, calibration_, points),
                                            static_cast<std::size_t>(params_.clique_budget));
  result.features_tracked = static_cast<std::uint32_t>(found.size());
  result.features_with_depth = static_cast<std::uint32_t>(with_depth.size());
  result.clique_size = static_cast<std::uint32_t>(clique.members.size());
  if (clique.members.size() < static_cast<std::size_t>(params_.min_inliers)) return found;
  std::vector<std::size_t> rigid;
  for (const std::size_t member : clique.members) rigid.push_back(with_depth[member]);
  return rigid;
}

PoseEstimate StereoOdometry::estimateFrom(const std::vector<std::size_t>& tracks, const MotionPrior& prior,
                                          const StereoView& guess) const {
  std::vector<MapObservation> observations;
  for (const std::size_t i : tracks)
    observations.push_back({landmarks_[i].p_world(), tracks_[i].seen, tracks_[i].votes});
  return estimator_.estimate(observations, prior, guess);
}

PoseEstimate StereoOdometry::estimatePose(const std::vector<std::size_t>& selected, const MotionPrior& prior,
                                          const StereoView& guess) {
  const PoseEstimate rigid = estimateFrom(selected, prior, guess);
  if (!rigid.converged) return rigid;
  // Once more with all that agree with that motion, also those without a depth of their own in this frame.
  const std::vector<std::size_t> found = foundTracks();
  const PoseEstimate estimate = estimateFrom(found, prior, rigid.view);
  for (std::size_t k = 0; k < found.size(); ++k) tracks_[found[k]].inlier = estimate.inlier[k];
  return estimate;
}

void StereoOdometry::updateTwist(const Images& images, const MotionPrior& prior) {
  const Eigen::Isometry3d T_camera_last =
      window_.back().view.T_camera_world * last_view_.T_camera_world.inverse();
  if (images.skew_s() != 0.0) {
    twist_ = Vector6d(logMotion(window_.back().view.T_late_camera) / images.skew_s());
  } else {
    twist_ = extrapolatedTwist(T_camera_last, prior.interval_s, std::nullopt);
  }
  T_last_before_ = T_camera_last;
  last_interval_s_ = prior.interval_s;
}

void StereoOdometry::expectSkew(const Images& images, const MotionPrior& prior) {
  WindowFrame& frame = window_.back();
  frame.skewed = images.skew_s() != 0.0;
  if (!frame.skewed) return;
  const Vector6d twist = extrapolatedTwist(frame.view.T_camera_world * prior.T_previous_world.inverse(),
                                           prior.interval_s, prior.previous_twist);
  frame.T_late_expected = expMotion(twist * images.skew_s());
  frame.late_sigma = lateSigma(prior);
  if (prior.R_late_camera) frame.T_late_expected.linear() = *prior.R_late_camera;
}

void StereoOdometry::smoothPreviousSkew(const Images& images) {
  if (last_skew_s_ == 0.0 || !last_is_keyframe_ || window_.size() < 2) return;
  WindowFrame& previous = window_[window_.size() - 2];
  const double after_s = images.left_time_s - last_left_time_s_;
  const Eigen::Isometry3d T_next =
      window_.back().view.T_camera_world * previous.view.T_camera_world.inverse();
  const Eigen::Matrix3d R_expected = previous.T_late_expected.linear();
  const Eigen::Vector3d rotation_sigma = previous.late_sigma.tail<3>();
  previous.T_late_expected = last_interval_s_ > 0.0 ? interpolatedMotion(T_next, after_s, T_last_before_,
                                                                         last_interval_s_, last_skew_s_)
                                                    : expMotion(logMotion(T_next) * last_skew_s_ / after_s);
  // Midway between two known poses, under white acceleration.
  const double spread = std::sqrt(after_s * after_s * after_s / 48.0);
  previous.late_sigma.head<3>().setConstant(std::sqrt(params_.acceleration_density) * spread);
  previous.late_sigma.tail<3>().setConstant(std::sqrt(params_.angular_acceleration_density) * spread);
  if (imu_.increment(last_left_time_s_, last_left_time_s_ + last_skew_s_)) {
    previous.T_late_expected.linear() = R_expected;
    previous.late_sigma.tail<3>() = rotation_sigma;
  }
}

void StereoOdometry::refineWindow() {
  const int current = static_cast<int>(window_.size()) - 1;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].inlier) landmarks_[i].views.push_back({current, tracks_[i].seen});
  }
  optimizer_.optimise(window_, landmarks_);
}

bool StereoOdometry::needsKeyframe() const {
  std::vector<double> parallax;
  for (const Track& track : tracks_) {
    if (track.inlier) parallax.push_back((track.seen.left_px - track.keyframe_px).norm());
  }
  if (static_cast<double>(parallax.size()) <
      params_.keyframes.min_tracked_share * static_cast<double>(keyframe_inliers_))
    return true;
  const auto middle = parallax.begin() + static_cast<std::ptrdiff_t>(parallax.size() / 2);
  std::nth_element(parallax.begin(), middle, parallax.end());
  return *middle > params_.keyframes.max_parallax_px;
}

void StereoOdometry::makeKeyframe(const Images& images, FrameResult& result) {
  for (Track& track : tracks_) {
    track.alive = track.alive && track.inlier;
    track.keyframe_px = track.seen.left_px;
  }
  replenish(images, result);
  keyframe_image_ = images.left;
  keyframe_inliers_ = static_cast<std::size_t>(
      std::count_if(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.alive; }));
  ++keyframe_id_;
  result.keyframe = true;
  dropOldFrames();
  compact();
}

void StereoOdometry::replenish(const Images& images, FrameResult& result) {
  std::vector<cv::Point2f> occupied;
  for (const Track& track : tracks_) {
    if (track.alive) occupied.push_back(toCv(track.seen.left_px));
  }
  const StereoView& view = window_.back().view;
  const Eigen::Isometry3d T_world_camera = view.T_camera_world.inverse();
  // At the very start nothing is known of the motion between the stamps.
  const double slack_px =
      window_.size() == 1 && window_.back().skewed ? epipolarSlack(window_.back().late_sigma) : 0.0;
  const std::vector<cv::Point2f> corners = detector_.detect(images.left.level(0), occupied);
  result.features_detected = static_cast<std::uint32_t>(corners.size());
  for (const cv::Point2f& corner : corners) {
    const Eigen::Vector2d px = toEigen(corner);
    const auto match = stereo_.search(images.left, images.right, view.T_late_camera, px, slack_px);
    if (!match) continue;
    Landmark landmark;
    landmark.id = next_id_++;
    landmark.T_world_anchor = T_world_camera;
    landmark.ray_depth = leftRay(calibration_, px);
    landmark.ray_depth.z() = match->depth.inverse_depth;
    Track track;
    track.keyframe_px = track.last_px = px;
    track.seen.left_px = px;
    track.seen.right_px = match->right_px;
    track.seen.has_right = true;
    track.found = track.inlier = true;
    landmark.views.push_back({static_cast<int>(window_.size()) - 1, track.seen});
    landmarks_.push_back(landmark);
    tracks_.push_back(track);
  }
}

void StereoOdometry::dropOldFrames() {
  const int excess = static_cast<int>(window_.size()) - params_.keyframes.window;
  if (excess <= 0) return;
  window_.erase(window_.begin(), window_.begin() + excess);
  for (Landmark& landmark : landmarks_) {
    auto& views = landmark.views;
    views.erase(std::remove_if(views.begin(), views.end(),
                               [excess](const LandmarkView& view) { return view.frame < excess; }),
                views.end());
    for (LandmarkView& view : views) view.frame -= excess;
  }
}

void StereoOdometry::compact() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (!tracks_[i].alive && landmarks_[i].views.size() < 2) continue;
    if (kept != i) {
      landmarks_[kept] = std::move(landmarks_[i]);
      tracks_[kept] = tracks_[i];
    }
    ++kept;
  }
  landmarks_.resize(kept);
  tracks_.resize(kept);
}

void StereoOdometry::report(FrameResult& result) const {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    if (!track.found) continue;
    FeatureReport report;
    report.id = landmarks_[i].id;
    report.current_px = toCv(track.seen.left_px);
    report.previous_px = track.fresh ? report.current_px : toCv(track.last_px);
    report.fate = track.fresh            ? FeatureReport::Fate::kDetected
                  : track.inlier         ? FeatureReport::Fate::kInlier
                  : track.seen.has_right ? FeatureReport::Fate::kRejected
                                         : FeatureReport::Fate::kNoDepth;
    report.p_camera = last_view_.T_camera_world * landmarks_[i].p_world();
    if (track.inlier && !track.fresh) ++result.inliers;
    result.features.push_back(report);
  }
}

}  // namespace stereo_nav::vo
