#pragma once

#include <array>
#include <string>
#include <vector>

#include "stereo_nav/calibration/board_pose.h"

namespace stereo_nav::calibration {

/// The figures of the calibration that one view of the board gives.
struct ViewFigures {
  std::string name;         ///< of the image pair
  BoardPose pose;           ///< of the board in this view
  double left_lens_px;      ///< lensError_px() of the left camera
  double right_lens_px;     ///< ... of the right one
  double epipolar_rms_px;   ///< of the row in the left minus the row in the right rectified image
  double epipolar_mean_px;  ///< its mean over the board
  double disparity_rms_px;  ///< of the disparity minus that of the pose that fits best
  double scale;             ///< triangulated size of the board / its true size
  /// Distance from the left camera to the middle of the board.
  double distance_m() const { return pose.T_camera_board.translation().norm(); }
};

/// Throws std::invalid_argument where the number of corners is not the board's; std::runtime_error where no
/// pose can be found, i.e. where the calibration is not that of the cameras.
ViewFigures measureView(const StereoRig& rig, const Checkerboard& board, const std::string& name,
                        const BoardCorners& corners);

/// A figure that must be at most (in magnitude) `limit`, else the calibration is poor.
struct Criterion {
  std::string name;    ///< what the figure measures
  std::string unit;    ///< of value and limit
  double value;        ///< the figure found
  double limit;        ///< the largest magnitude that is good
  std::string remedy;  ///< what to do when it is not met
  /// Whether the figure is good enough.
  bool met() const { return value <= limit && value >= -limit; }
};

/// The figures of a calibration from a set of views.
struct CalibrationCheck {
  std::vector<ViewFigures> views;  ///< one for each view
  double left_lens_px;             ///< RMS over all corners of all views
  double right_lens_px;            ///< the same of the right camera
  double reprojection_px;   ///< ... with one pose for both cameras, in the rectified images, per corner
  double epipolar_rms_px;   ///< RMS of ViewFigures::epipolar_rms_px
  double epipolar_mean_px;  ///< mean of ViewFigures::epipolar_mean_px
  double disparity_rms_px;  ///< RMS of ViewFigures::disparity_rms_px
  double scale_error;       ///< median of ViewFigures::scale, less 1
  double seen_share;        ///< of the left image's 4x3 parts that held a corner
  std::vector<Criterion> criteria;  ///< what the verdict is made of
  std::vector<std::string> notes;   ///< what the figures cannot tell, since the views lack it

  /// Whether all criteria are met.
  bool good() const;

  /// Standard deviation of a depth from one disparity with the noise measured: z^2 sigma_d / (f b).
  double depthNoise_m(const vision::StereoCalibration& calibration, double depth_m) const;
};

/// Limits of the verdict. The reprojection and epipolar ones are twice what camera_calibration's tutorials
/// call acceptable (0.25 px); block matching and the odometry begin to lose matches beyond.
struct CheckLimits {
  double lens_px = 0.5;          ///< of CalibrationCheck::left_lens_px and right_lens_px
  double reprojection_px = 0.7;  ///< of CalibrationCheck::reprojection_px
  double epipolar_px = 0.5;      ///< of CalibrationCheck::epipolar_rms_px and epipolar_mean_px
  double disparity_px = 0.5;     ///< of CalibrationCheck::disparity_rms_px
  double scale = 0.01;           ///< of CalibrationCheck::scale_error
};

/// `views` must not be empty. The corners are needed in addition, to see which part of the image they cover.
CalibrationCheck checkCalibration(const StereoRig& rig, const std::vector<ViewFigures>& views,
                                  const std::vector<BoardCorners>& corners, const CheckLimits& limits = {});

}  // namespace stereo_nav::calibration
