#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::odometry {

/// One static point seen in two frames.
struct PointPair {
  Eigen::Vector3d p_previous;  ///< left optical frame of the previous image, m
  Eigen::Vector3d p_current;   ///< left optical frame of the current image, m
};

/// Camera displacement, expressed in the current camera frame: t = (1/N) sum(R_current_previous a_n - b_n)
/// (thesis, step 7). `pairs` must not be empty.
Eigen::Vector3d meanTranslation(const Eigen::Matrix3d& R_current_previous,
                                const std::vector<PointPair>& pairs);

/// T_current_previous with the least sum of |T a - b|^2 (Umeyama 1991, without scale). Needs at least 3
/// pairs; of points on one line the rotation about that line is arbitrary.
Eigen::Isometry3d alignPoints(const std::vector<PointPair>& pairs);

struct RefinementParams {
  int iterations = 20;
  double huber_px = 1.0;
  double max_error_px = 2.0;

  void describe(ParameterVisitor& visitor);
};

/// The result of refineMotion().
struct RefinedMotion {
  Eigen::Isometry3d T_current_previous = Eigen::Isometry3d::Identity();
  /// Covariance of the left perturbation (translation m, rotation rad), scaled to the noise of the residuals.
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<bool> inlier;  ///< per pair: reprojection error at most max_error_px
  std::size_t inliers = 0;
  double rms_px = 0.0;  ///< over the inliers, of (x_left, y, x_right)
  bool converged = false;
};

/// Gauss-Newton with a Huber loss on the stereo reprojection error (x_left, y, x_right) in the current frame,
/// of the points lifted in the previous one; then once more on those within max_error_px. Pairs that cannot
/// be projected are outliers.
RefinedMotion refineMotion(const RefinementParams& params, const vision::StereoCalibration& calibration,
                           const std::vector<PointPair>& pairs, const Eigen::Isometry3d& T_current_previous);

/// Residual of one pair (observed - projected, px: x_left, y, x_right) and its Jacobian by the left
/// perturbation T <- expMotion(delta) T. The point must be at least vision::kNearestDepth_m in front of the
/// current camera.
Eigen::Vector3d reprojectionResidual(const vision::StereoCalibration& calibration, const PointPair& pair,
                                     const Eigen::Isometry3d& T_current_previous,
                                     Eigen::Matrix<double, 3, 6>* jacobian);

/// Whether the point of the pair lies far enough in front of the current camera to be projected.
bool isProjectable(const PointPair& pair, const Eigen::Isometry3d& T_current_previous);

}  // namespace stereo_nav::odometry
