#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/eval/timing.h"

namespace stereo_nav::eval {

/// The result of the odometry for one input frame.
struct FrameRecord {
  double time_s = 0.0;                           ///< stamp of the left image
  std::optional<Eigen::Isometry3d> T_odom_base;  ///< absent: the frame is lost
  double clock_offset_s = 0.0;  ///< that was added to the recorded stamp, where the clock was set back
  std::string reason;           ///< why the frame is lost; empty where it is not
  unsigned features = 0;        ///< number of features of the frame
  unsigned inliers = 0;         ///< features that agree with the motion found
  std::optional<Matrix6d> pose_covariance;  ///< of T_odom_base, axes of odom: m, m, m, rad, rad, rad
  FrameTiming timing;                       ///< how long the frame took
};

/// Everything that the errors of a run are computed from.
struct EvaluationInput {
  std::string input;                ///< as named on the command line; goes into the summary
  std::string config;               ///< likewise
  std::vector<FrameRecord> frames;  ///< every input frame, in order of time
  std::size_t stretches = 1;        ///< between which the clock was set back; time_s goes on
  std::string imu_set_aside;        ///< why the recorded IMU was not used; empty: it was, or there is none
  std::vector<std::string> notes;   ///< what had to be assumed or was left out, one line each
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();  ///< of the left optical frame
  std::string camera_frame;  ///< name of that frame, for messages; may be empty
  Trajectory ground_truth;   ///< of base_link in any fixed frame; empty: no ground truth (see ofOtherBody())
  double truth_sigma_m =
      0.0;  ///< noise of the ground truth's poses, each axis, independent from pose to pose
  double truth_sigma_rad = 0.0;  ///< likewise of their attitudes
  /// Covariance of the pose of base_link in frame `to` relative to frame `from`, axes of base_link in `to`:
  /// m, rad. Empty where nothing is known.
  std::function<Matrix6d(std::size_t from, std::size_t to)> relative_covariance;
  /// Lengths of the pieces that EvaluationSummary::segments are taken over, m.
  std::vector<double> segment_lengths_m;
  /// How far base_link had come at each frame, m, where the ground truth's own way is too long since its
  /// poses jitter; empty: the way of the ground truth.
  std::vector<double> way_m;
  bool planar =
      false;  ///< the odometry knows x, y and yaw alone: only these are held against the covariances
};

/// Whether covariances are as large as the errors: normalised estimation errors squared of relative poses
/// over disjoint pieces of equal duration.
struct Nees {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  ///< without a piece
  int expected = 6;                     ///< what `mean` is of right covariances; 3 in the plane
  int expected_translation = 3;         ///< likewise of `translation`; 2 in the plane
  int expected_rotation = 3;            ///< likewise of `rotation`; 1 in the plane
  double mean = kUnknown;               ///< of all axes
  double translation = kUnknown;        ///< of the translation alone
  double rotation = kUnknown;           ///< of the rotation alone
  double inside_95_percent = kUnknown;  ///< pieces whose error lies inside the ellipsoid of 95 %, percent
  std::size_t pairs = 0;                ///< pieces
};

/// Errors of the motion over pieces of one length, from every frame on.
struct SegmentErrors {
  double length_m = 0.0;                                                  ///< of each piece
  double translation_percent = std::numeric_limits<double>::quiet_NaN();  ///< mean, of the length
  double rotation_deg_per_m = std::numeric_limits<double>::quiet_NaN();   ///< mean
  std::size_t pairs = 0;                                                  ///< pieces
};

/// Durations over which Nees are taken, s.
constexpr std::array<double, 3> kNeesIntervals_s = {0.2, 1.0, 5.0};

/// summary.json. Numbers that cannot be known (no ground truth, path too short) are NaN, `null` in the file.
///
/// A frame without a pose keeps the last one (before the first pose: the start) and counts as lost. Absolute,
/// relative and end errors and the path are those of the left camera; the errors per axis are those of
/// base_link.
struct EvaluationSummary {
  /// The value of a number that cannot be known.
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::size_t frames = 0;       ///< all input frames
  std::size_t frames_lost = 0;  ///< those without a pose
  double path_length_m =
      kUnknown;                  ///< of the ground truth at the frames; of the estimate where there is none
  double ate_rmse_m = kUnknown;  ///< positions after SE(3) alignment without scale
  double rpe_translation_percent = kUnknown;  ///< relativeError()
  double rpe_rotation_deg_per_m = kUnknown;   ///< relativeError()
  std::vector<double> segment_lengths_m;      ///< over which relativeError() is taken
  std::vector<SegmentErrors> segments;        ///< over EvaluationInput::segment_lengths_m
  std::size_t steps_off = 0;  ///< from one frame to the next that are more than 0.3 m or 10 degrees off
  double end_error_percent =
      kUnknown;  ///< distance at the last frame, first poses laid together, of the path
  double rmse_x_m =
      kUnknown;  ///< along an axis of `odom`, first poses laid together, as the thesis reports it
  double rmse_y_m = kUnknown;                      ///< the same along the y axis
  double mae_x_m = kUnknown;                       ///< mean absolute error along the x axis
  double mae_y_m = kUnknown;                       ///< the same along the y axis
  double inliers_mean = kUnknown;                  ///< over all frames but the first, which has no motion
  double features_mean = kUnknown;                 ///< over all frames
  std::string config;                              ///< EvaluationInput::config
  std::string input;                               ///< EvaluationInput::input
  std::string imu_set_aside;                       ///< EvaluationInput::imu_set_aside
  std::size_t stretches = 1;                       ///< EvaluationInput::stretches
  std::size_t frames_with_ground_truth = 0;        ///< those the errors are taken over
  std::array<Nees, kNeesIntervals_s.size()> nees;  ///< over kNeesIntervals_s
  bool planar = false;                             ///< EvaluationInput::planar; not in summary.json
};

/// One frame as the report draws it.
struct FrameErrors {
  double time_s = 0.0;                                      ///< since the first frame
  bool lost = false;                                        ///< the frame has no pose
  std::string reason;                                       ///< FrameRecord::reason
  unsigned features = 0;                                    ///< FrameRecord::features
  unsigned inliers = 0;                                     ///< FrameRecord::inliers
  Eigen::Vector3d position_m;                               ///< base_link in odom, held while lost
  std::optional<Eigen::Vector3d> ground_truth_m;            ///< base_link in odom, first poses laid together
  double absolute_error_m = EvaluationSummary::kUnknown;    ///< left camera, after SE(3) alignment
  double rotation_error_deg = EvaluationSummary::kUnknown;  ///< first poses laid together
  std::optional<Matrix6d> pose_covariance;                  ///< FrameRecord::pose_covariance
};

/// The errors of a run, as a whole and frame by frame.
struct Evaluation {
  EvaluationSummary summary;        ///< of the whole run
  std::vector<FrameErrors> frames;  ///< one for each input frame
};

/// Throws InputError when there is no frame, or when there is ground truth but fewer than three frames
/// find a pose in it; the message names both intervals of time.
Evaluation evaluate(const EvaluationInput& input);

/// base_link in odom, one pose for each frame that has one: trajectory.tum.
Trajectory estimatedTrajectory(const EvaluationInput& input);

/// The left camera in its first pose, one pose for every frame (lost ones repeat): trajectory.kitti.
Trajectory cameraTrajectory(const EvaluationInput& input);

/// Text of summary.json: fixed order of the keys, numbers in the shortest form that reads back as the same
/// double.
std::string toJson(const EvaluationSummary& summary);

/// Text of frames.csv: a line of names, then one line for each frame with the fields of FrameErrors; what is
/// not known is left empty.
std::string toCsv(const std::vector<FrameErrors>& frames);

}  // namespace stereo_nav::eval
