#include "stereo_nav/eval/evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "core/point_alignment.h"
#include "eval/alignment.h"
#include "eval/consistency.h"
#include "eval/json_text.h"
#include "eval/metrics.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::eval {
namespace {

/// Fewest frames with ground truth. Fewer may overlap by chance, and do not determine an alignment.
constexpr std::size_t kMinFramesWithGroundTruth = 3;

/// base_link in odom for every frame. A lost frame keeps the last pose; frames before the first pose get the
/// first pose.
Poses heldPoses(const std::vector<FrameRecord>& frames) {
  Eigen::Isometry3d held = Eigen::Isometry3d::Identity();
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
    held = frame->T_odom_base.value_or(held);
  Poses poses;
  for (const auto& frame : frames) {
    held = frame.T_odom_base.value_or(held);
    poses.push_back(held);
  }
  return poses;
}

/// The frames that have ground truth: their indices, and the estimated and the true poses of base_link.
struct AssociatedPoses {
  std::vector<std::size_t> frames;
  Poses T_odom_base;
  Poses T_world_base;
};

AssociatedPoses associate(const EvaluationInput& input, const Poses& T_odom_base) {
  AssociatedPoses associated;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    const auto T_world_base = poseAt(input.ground_truth, input.frames[i].time_s);
    if (!T_world_base) continue;
    associated.frames.push_back(i);
    associated.T_odom_base.push_back(T_odom_base[i]);
    associated.T_world_base.push_back(*T_world_base);
  }
  if (associated.frames.size() >= kMinFramesWithGroundTruth) return associated;
  throw InputError(fmt::format(
      "only {} of {} frames have ground truth: the frames are from {:.3f} to {:.3f} s, the ground truth from "
      "{:.3f} to {:.3f} s; give the ground truth of this recording, in the same clock",
      associated.frames.size(), input.frames.size(), input.frames.front().time_s, input.frames.back().time_s,
      input.ground_truth.front().time_s, input.ground_truth.back().time_s));
}

Poses moved(const Eigen::Isometry3d& T_new_old, const Poses& poses, const Eigen::Isometry3d& T_body_other) {
  Poses result;
  for (const auto& pose : poses) result.push_back(T_new_old * pose * T_body_other);
  return result;
}

std::vector<Eigen::Vector3d> positions(const Poses& poses) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& pose : poses) result.push_back(pose.translation());
  return result;
}

/// Absolute, relative and end errors of the left camera.
void addCameraErrors(const AssociatedPoses& associated, const Eigen::Isometry3d& T_base_camera,
                     Evaluation& evaluation) {
  const auto identity = Eigen::Isometry3d::Identity();
  const Poses truth = moved(identity, associated.T_world_base, T_base_camera);
  const Poses estimate = moved(identity, associated.T_odom_base, T_base_camera);
  EvaluationSummary& summary = evaluation.summary;
  summary.path_length_m = pathLength(positions(truth));

  const Eigen::Isometry3d T_world_odom = alignRigidly(positions(estimate), positions(truth));
  const auto aligned = positions(moved(T_world_odom, estimate, identity));
  summary.ate_rmse_m = rmse(aligned, positions(truth));
  for (std::size_t k = 0; k < truth.size(); ++k) {
    evaluation.frames[associated.frames[k]].absolute_error_m = (aligned[k] - truth[k].translation()).norm();
  }

  const auto relative = relativeError(truth, estimate, segmentLengths(summary.path_length_m));
  summary.rpe_translation_percent = relative.translation_percent;
  summary.rpe_rotation_deg_per_m = relative.rotation_deg_per_m;
  summary.segment_lengths_m = relative.lengths_m;

  if (summary.path_length_m > 0.0) {
    const Eigen::Isometry3d T_truth = truth.front().inverse() * truth.back();
    const Eigen::Isometry3d T_estimate = estimate.front().inverse() * estimate.back();
    const double end_error_m = (T_truth.translation() - T_estimate.translation()).norm();
    summary.end_error_percent = 100.0 * end_error_m / summary.path_length_m;
  }
}

/// Errors of base_link along the axes of odom.
void addBaseErrors(const AssociatedPoses& associated, Evaluation& evaluation) {
  const Eigen::Isometry3d T_odom_world =
      associated.T_odom_base.front() * associated.T_world_base.front().inverse();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d magnitudes = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < associated.frames.size(); ++k) {
    const Eigen::Isometry3d truth = T_odom_world * associated.T_world_base[k];
    const Eigen::Vector3d error = associated.T_odom_base[k].translation() - truth.translation();
    squares += error.cwiseAbs2();
    magnitudes += error.cwiseAbs();
    FrameErrors& frame = evaluation.frames[associated.frames[k]];
    frame.ground_truth_m = truth.translation();
    frame.rotation_error_deg = angleDeg(truth.linear().transpose() * associated.T_odom_base[k].linear());
  }
  const auto n = static_cast<double>(associated.frames.size());
  EvaluationSummary& summary = evaluation.summary;
  summary.rmse_x_m = std::sqrt(squares.x() / n);
  summary.rmse_y_m = std::sqrt(squares.y() / n);
  summary.mae_x_m = magnitudes.x() / n;
  summary.mae_y_m = magnitudes.y() / n;
}

Evaluation withoutGroundTruth(const EvaluationInput& input, const Poses& T_odom_base) {
  Evaluation evaluation;
  EvaluationSummary& summary = evaluation.summary;
  summary.input = input.input;
  summary.config = input.config;
  summary.imu_set_aside = input.imu_set_aside;
  summary.stretches = input.stretches;
  summary.planar = input.planar;
  summary.frames = input.frames.size();
  summary.path_length_m =
      pathLength(positions(moved(Eigen::Isometry3d::Identity(), T_odom_base, input.T_base_camera)));
  double features = 0.0;
  double inliers = 0.0;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    const FrameRecord& record = input.frames[i];
    FrameErrors frame;
    frame.time_s = record.time_s - input.frames.front().time_s;
    frame.lost = !record.T_odom_base;
    frame.reason = record.reason;
    frame.features = record.features;
    frame.inliers = record.inliers;
    frame.pose_covariance = record.pose_covariance;
    frame.position_m = T_odom_base[i].translation();
    evaluation.frames.push_back(frame);
    summary.frames_lost += frame.lost ? 1 : 0;
    features += record.features;
    if (i > 0) inliers += record.inliers;
  }
  summary.features_mean = features / static_cast<double>(summary.frames);
  if (summary.frames > 1) summary.inliers_mean = inliers / static_cast<double>(summary.frames - 1);
  return evaluation;
}

/// Over the lengths that were asked for.
void addSegments(const AssociatedPoses& associated, const EvaluationInput& input,
                 EvaluationSummary& summary) {
  std::vector<double> way_m = wayTo(associated.T_world_base);
  if (!input.way_m.empty()) {
    for (std::size_t k = 0; k < way_m.size(); ++k) way_m[k] = input.way_m.at(associated.frames[k]);
  }
  for (const double length_m : input.segment_lengths_m)
    summary.segments.push_back(
        segmentErrors(associated.T_world_base, associated.T_odom_base, way_m, length_m));
  summary.steps_off = stepsOff(associated.T_world_base, associated.T_odom_base);
}

JsonObject toJson(const SegmentErrors& errors) {
  JsonObject json;
  json.add("translation_percent", errors.translation_percent);
  json.add("rotation_deg_per_m", errors.rotation_deg_per_m);
  json.add("pairs", errors.pairs);
  return json;
}

JsonObject toJson(const Nees& nees) {
  JsonObject json;
  json.add("expected", nees.expected);
  json.add("mean", nees.mean);
  json.add("translation", nees.translation);
  json.add("rotation", nees.rotation);
  json.add("inside_95_percent", nees.inside_95_percent);
  json.add("pairs", nees.pairs);
  return json;
}

}  // namespace

Evaluation evaluate(const EvaluationInput& input) {
  if (input.frames.empty()) throw InputError(input.input + ": holds no stereo frame to evaluate");
  const Poses T_odom_base = heldPoses(input.frames);
  Evaluation evaluation = withoutGroundTruth(input, T_odom_base);
  if (input.ground_truth.empty()) return evaluation;
  const AssociatedPoses associated = associate(input, T_odom_base);
  evaluation.summary.frames_with_ground_truth = associated.frames.size();
  addCameraErrors(associated, input.T_base_camera, evaluation);
  addBaseErrors(associated, evaluation);
  addSegments(associated, input, evaluation.summary);
  if (input.relative_covariance) {
    for (std::size_t k = 0; k < kNeesIntervals_s.size(); ++k)
      evaluation.summary.nees[k] = neesOver(kNeesIntervals_s[k], input);
  }
  return evaluation;
}

Trajectory estimatedTrajectory(const EvaluationInput& input) {
  Trajectory trajectory;
  for (const auto& frame : input.frames) {
    if (frame.T_odom_base) trajectory.push_back({frame.time_s - frame.clock_offset_s, *frame.T_odom_base});
  }
  return trajectory;
}

Trajectory cameraTrajectory(const EvaluationInput& input) {
  const Poses T_odom_camera =
      moved(Eigen::Isometry3d::Identity(), heldPoses(input.frames), input.T_base_camera);
  Trajectory trajectory;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    trajectory.push_back({input.frames[i].time_s, T_odom_camera.front().inverse() * T_odom_camera[i]});
  }
  return trajectory;
}

std::string toJson(const EvaluationSummary& summary) {
  JsonObject json;
  json.add("frames", summary.frames);
  json.add("frames_lost", summary.frames_lost);
  json.add("path_length_m", summary.path_length_m);
  json.add("ate_rmse_m", summary.ate_rmse_m);
  json.add("rpe_translation_percent", summary.rpe_translation_percent);
  json.add("rpe_rotation_deg_per_m", summary.rpe_rotation_deg_per_m);
  json.add("segment_lengths_m", summary.segment_lengths_m);
  JsonObject segments;
  for (const SegmentErrors& errors : summary.segments)
    segments.add(fmt::format("{:g}", errors.length_m), toJson(errors));
  json.add("segments", segments);
  json.add("steps_off", summary.steps_off);
  json.add("end_error_percent", summary.end_error_percent);
  json.add("rmse_x_m", summary.rmse_x_m);
  json.add("rmse_y_m", summary.rmse_y_m);
  json.add("mae_x_m", summary.mae_x_m);
  json.add("mae_y_m", summary.mae_y_m);
  json.add("inliers_mean", summary.inliers_mean);
  json.add("features_mean", summary.features_mean);
  json.add("config", summary.config);
  json.add("input", summary.input);
  json.add("frames_with_ground_truth", summary.frames_with_ground_truth);
  json.add("imu_set_aside", summary.imu_set_aside);
  json.add("stretches", summary.stretches);
  JsonObject intervals;
  for (std::size_t k = 0; k < kNeesIntervals_s.size(); ++k)
    intervals.add(fmt::format("{:g}", kNeesIntervals_s[k]), toJson(summary.nees[k]));
  json.add("nees", intervals);
  return json.text() + "\n";
}

}  // namespace stereo_nav::eval
