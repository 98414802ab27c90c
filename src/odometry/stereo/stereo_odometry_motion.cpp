// StereoOdometry: what is expected of the motion, and what the features make of it.
#include <algorithm>
#include <cmath>

#include "odometry/stereo/stereo_odometry.h"

namespace stereo_nav::odometry {
namespace {

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

vision::StereoView StereoOdometry::predict(const Images& images, const MotionPrior& prior) const {
  const Vector6d twist = twist_.value_or(Vector6d::Zero());
  Eigen::Isometry3d T_camera_previous = expMotion(twist * prior.interval_s);
  vision::StereoView view;
  view.T_late_camera = expMotion(twist * images.skew_s());
  if (prior.R_camera_previous) T_camera_previous.linear() = *prior.R_camera_previous;
  if (prior.R_late_camera) view.T_late_camera.linear() = *prior.R_late_camera;
  view.T_camera_world = T_camera_previous * prior.T_previous_world;
  return view;
}

Vector6d StereoOdometry::twistAt(const vision::StereoView& view, const MotionPrior& prior) const {
  return extrapolatedTwist(view.T_camera_world * prior.T_previous_world.inverse(), prior.interval_s,
                           prior.previous_twist);
}

void StereoOdometry::straighten(const vision::StereoView& view, const MotionPrior& prior) {
  if (shutter_.isGlobal()) {
    for (Track& track : tracks_) track.seen = track.in_image;
    return;
  }
  row_twist_ = twistAt(view, prior);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (!track.found) continue;
    track.seen = shutter_.atStamp(track.in_image, view.T_camera_world * landmarks_[i].p_world(),
                                  view.T_late_camera, row_twist_);
  }
}

void StereoOdometry::straightenStart(const Vector6d& twist) {
  start_is_bent_ = false;
  const vision::StereoView& view = window_.front().view;
  for (Landmark& landmark : landmarks_) {
    placeAtStamp(landmark, landmark.views.front().seen, view, twist);
  }
}

void StereoOdometry::placeAtStamp(Landmark& landmark, vision::StereoObservation& seen,
                                  const vision::StereoView& view, const Vector6d& twist) const {
  landmark.ray_depth = shutter_.rayDepthAtStamp(seen.left_px, landmark.ray_depth.z(), twist);
  if (shutter_.isGlobal()) return;
  // Left and right rows have times of their own, so that the depth was one of a moving point.
  seen = shutter_.atStamp(seen, view.T_camera_world * landmark.p_world(), view.T_late_camera, twist);
  const vision::Triangulation still =
      vision::triangulate(calibration_, view.T_late_camera, seen.left_px, seen.right_px);
  if (still.inverse_depth <= 0.0) return;
  landmark.ray_depth = vision::leftRay(calibration_, seen.left_px);
  landmark.ray_depth.z() = still.inverse_depth;
}

vision::StereoView StereoOdometry::leftOnlyView(const MotionPrior& prior,
                                                const vision::StereoView& predicted) {
  for (Track& track : tracks_) track.in_image.has_right = false;
  straighten(predicted, prior);
  const PoseEstimate estimate = estimateFrom(foundTracks(), prior, predicted);
  return estimate.converged ? estimate.view : predicted;
}

double StereoOdometry::epipolarSlack(const Vector6d& late_sigma) const {
  constexpr double kNearDepth_m = 3.0;
  return calibration_.fx * (late_sigma.tail<3>().maxCoeff() + late_sigma.head<3>().maxCoeff() / kNearDepth_m);
}

bool StereoOdometry::hasEnoughInliers(const PoseEstimate& estimate) const {
  return estimate.converged && estimate.inliers >= static_cast<std::size_t>(params_.min_inliers);
}

bool StereoOdometry::isThin(const PoseEstimate& estimate) const {
  constexpr double kThinShare = 0.6;
  const auto alive =
      std::count_if(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.alive; });
  return static_cast<double>(estimate.inliers) < kThinShare * static_cast<double>(alive);
}

bool StereoOdometry::isCarriedAway(const PoseEstimate& estimate, const MotionPrior& prior) const {
  constexpr double kSigmas = 5.0;
  if (!hasEnoughInliers(estimate)) return false;
  if (last_interval_s_ == 0.0) return false;
  const Eigen::Isometry3d T_camera_last = estimate.view.T_camera_world * prior.T_previous_world.inverse();
  const Vector6d change =
      logMotion(T_camera_last) / prior.interval_s - logMotion(T_last_before_) / last_interval_s_;
  const double time_s = 0.5 * (prior.interval_s + last_interval_s_);
  return change.head<3>().norm() > kSigmas * std::sqrt(params_.acceleration_density * time_s);
}

bool StereoOdometry::waitsForMovers(const Images& images) const {
  constexpr double kPatience_s = 1.0;
  return movers_fill_view_ && images.left_time_s - last_left_time_s_ < kPatience_s;
}

std::vector<std::size_t> StereoOdometry::tracksNear(const vision::StereoView& view) const {
  std::vector<std::size_t> near;
  for (const std::size_t i : foundTracks()) {
    if ((predictedPixel(i, view) - tracks_[i].seen.left_px).norm() <= params_.motion.max_error_px)
      near.push_back(i);
  }
  return near;
}

PoseEstimate StereoOdometry::estimateFrom(const std::vector<std::size_t>& tracks, const MotionPrior& prior,
                                          const vision::StereoView& guess) const {
  std::vector<MapObservation> observations;
  for (const std::size_t i : tracks)
    observations.push_back({landmarks_[i].p_world(), tracks_[i].seen, tracks_[i].votes});
  return estimator_.estimate(observations, prior, guess);
}

PoseEstimate StereoOdometry::estimatePose(const std::vector<std::size_t>& selected, const MotionPrior& prior,
                                          const vision::StereoView& guess) {
  straighten(guess, prior);
  const PoseEstimate rigid = estimateFrom(selected, prior, guess);
  if (!rigid.converged) return rigid;
  straighten(rigid.view, prior);
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
  frame.T_late_expected = expMotion(twistAt(frame.view, prior) * images.skew_s());
  frame.late_sigma = prior.lateSigma();
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

}  // namespace stereo_nav::odometry
