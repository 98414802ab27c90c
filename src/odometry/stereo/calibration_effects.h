#pragma once

#include <vector>

#include "odometry/stereo/lens_error_fields.h"
#include "odometry/stereo/pose_estimator.h"
#include "odometry/stereo/track.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// What errors of the calibration do to the motion of a frame, by one linear step of the estimation: a
/// landmark is wrong by what its pixels in the previous frame were, and the pixels of the current frame are
/// wrong by what holds where the landmark is now. Where nothing has moved the two cancel.
class CalibrationEffectsModel {
 public:
  /// `loss_px`: of the estimation, see PoseEstimatorParams.
  CalibrationEffectsModel(double loss_px, const vision::StereoCalibration& calibration)
      : loss_px_(loss_px), calibration_(calibration), fields_(calibration) {}

  /// The motion T_previous_current was found by `estimate` from the inliers among `tracks`.
  CalibrationEffects of(const std::vector<Track>& tracks, const PoseEstimate& estimate,
                        const Eigen::Isometry3d& T_previous_current) const;

 private:
  using Shifts =
      Eigen::Matrix<double, 4, CalibrationEffects::ColsAtCompileTime>;  ///< px, left x, y, right x, y

  /// By how much the errors shift the pixels of a point, and by how much the point that is computed from
  /// them.
  Shifts shifts(const Eigen::Vector3d& p_camera) const;
  Eigen::Matrix<double, 3, CalibrationEffects::ColsAtCompileTime> pointErrors(
      const Eigen::Vector3d& p_camera) const;

  double loss_px_;
  vision::StereoCalibration calibration_;
  LensErrorFields fields_;
};

}  // namespace stereo_nav::odometry
