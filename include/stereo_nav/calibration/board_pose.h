#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "stereo_nav/calibration/checkerboard.h"
#include "stereo_nav/calibration/stereo_rig.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::calibration {

/// The pose of the board from one stereo view, and how well the view and the calibration agree.
struct BoardPose {
  /// Board frame (see Checkerboard::corners()) -> rectified left optical frame.
  Eigen::Isometry3d T_camera_board = Eigen::Isometry3d::Identity();
  /// Covariance of the left perturbation of T_camera_board (m, rad), from the residuals of this view.
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<Eigen::Vector4d> residual_px;  ///< per corner, observed - predicted: left x, y, right x, y
};

/// Pose that fits all corners in both rectified images best (Gauss-Newton on the reprojection error, from the
/// rigid alignment of the triangulated corners; Umeyama, PAMI 1991). Returns nothing where a corner has no
/// positive disparity or the fit fails, as when left and right are swapped or the calibration belongs to
/// another rig.
std::optional<BoardPose> estimateBoardPose(const vision::StereoCalibration& calibration,
                                           const Checkerboard& board,
                                           const std::vector<Eigen::Vector2d>& left_rect_px,
                                           const std::vector<Eigen::Vector2d>& right_rect_px);

/// The rotation of the board, rad, which is zero when it faces the left camera squarely: R = Ry(yaw)
/// Rx(pitch) Rz(roll) in optical axes. Yaw > 0: its right edge is nearer than the left one; pitch > 0: its
/// lower edge is farther than the upper one; roll > 0: clockwise as seen.
struct BoardAngles {
  double yaw_rad;    ///< about the vertical axis
  double pitch_rad;  ///< about the horizontal axis
  double roll_rad;   ///< about the viewing direction
};
/// Takes the rotation of a pose apart.
BoardAngles boardAngles(const Eigen::Matrix3d& R_camera_board);

/// RMS distance in px between the corners in one raw image and those of the pose that fits them best. It
/// tests the lens model (K, D) alone.
double lensError_px(const CameraModel& camera, const Checkerboard& board,
                    const std::vector<cv::Point2f>& raw_px);

}  // namespace stereo_nav::calibration
