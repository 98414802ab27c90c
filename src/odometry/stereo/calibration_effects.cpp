#include "odometry/stereo/calibration_effects.h"

#include "vision/reprojection.h"

namespace stereo_nav::odometry {

CalibrationEffects CalibrationEffectsModel::of(const std::vector<Track>& tracks, const PoseEstimate& estimate,

                                               const Eigen::Isometry3d& T_previous_current) const {
  CalibrationEffects gradient = CalibrationEffects::Zero();
  const Eigen::Matrix3d R_current_previous = T_previous_current.linear().transpose();
  vision::ViewResidual residual;
  for (const Track& track : tracks) {
    if (!track.inlier) continue;
    const Eigen::Vector3d p_current = estimate.view.T_camera_world * track.p_world;
    const Eigen::Vector3d p_previous = T_previous_current * p_current;
    if (p_previous.z() < vision::kNearestDepth_m ||
        !vision::viewResidual(calibration_, estimate.view, track.p_world, track.at_stamp, residual))
      continue;
    const double weight = vision::robustWeight(residual.error_px, track.at_stamp.noise, loss_px_);
    const Shifts wrong =
        shifts(p_current) + residual.by_camera_point * R_current_previous * pointErrors(p_previous);
    gradient.noalias() += weight * residual.by_pose.transpose() * wrong;
  }
  return estimate.covariance / estimate.variance_px2 * gradient;
}

CalibrationEffectsModel::Shifts CalibrationEffectsModel::shifts(const Eigen::Vector3d& p_camera) const {
  constexpr int kFields = LensErrorFields::kFields;
  const Eigen::Vector2d left = p_camera.head<2>() / p_camera.z();
  const Eigen::Vector2d right(left.x() - calibration_.baseline_m / p_camera.z(), left.y());
  Shifts shifts = Shifts::Zero();
  shifts(2, 0) = 1.0;
  shifts.block<2, kFields>(0, 1) = fields_.at(left);
  shifts.block<2, kFields>(2, 1 + kFields) = fields_.at(right);
  return shifts;
}

Eigen::Matrix<double, 3, CalibrationEffects::ColsAtCompileTime> CalibrationEffectsModel::pointErrors(
    const Eigen::Vector3d& p_camera) const {
  const Shifts seen = shifts(p_camera);
  const double disparity_px = calibration_.fx * calibration_.baseline_m / p_camera.z();
  Eigen::Matrix<double, 3, CalibrationEffects::ColsAtCompileTime> errors =
      p_camera * (seen.row(2) - seen.row(0)) / disparity_px;
  errors.row(0) += p_camera.z() / calibration_.fx * seen.row(0);
  errors.row(1) += p_camera.z() / calibration_.fy * 0.5 * (seen.row(1) + seen.row(3));
  return errors;
}

}  // namespace stereo_nav::odometry
