#pragma once

#include <optional>
#include <vector>

#include "odometry/stereo/motion_prior.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "vision/reprojection.h"

namespace stereo_nav::odometry {

struct PoseEstimatorParams {
  int iterations = 15;
  double loss_px = 0.2;
  double max_error_px = 3.0;

  void describe(ParameterVisitor& visitor);
};

/// A point of the map and where it was seen in the frame.
struct MapObservation {
  Eigen::Vector3d p_world;
  vision::StereoObservation seen;
  bool reliable = true;  ///< otherwise it is only judged by the motion that the reliable ones have
};

/// The result of PoseEstimator; not to be used unless `converged`.
struct PoseEstimate {
  vision::StereoView view;
  Matrix6d covariance = Matrix6d::Zero();  ///< of the left perturbation of T_camera_world: m, rad
  std::vector<double> error_px;            ///< per observation: the larger one of left and right
  std::vector<bool> inlier;                ///< error_px at most max_error_px
  std::size_t inliers = 0;
  double rms_px = 0.0;        ///< per coordinate, over the inliers
  double variance_px2 = 0.0;  ///< of the pixels, per unit of the information that the covariance inverts
  bool converged = false;
};

/// Motion-only estimation against known points: Gauss-Newton with a Cauchy loss on the pixels of the left and
/// the right image, each at its own time. Where the stamps differ, the motion between them is estimated along
/// with the pose; a prior of constant acceleration ties the two together.
class PoseEstimator {
 public:
  PoseEstimator(const PoseEstimatorParams& params, const vision::StereoCalibration& calibration)
      : params_(params), calibration_(calibration) {}

  PoseEstimate estimate(const std::vector<MapObservation>& observations, const MotionPrior& prior,
                        const vision::StereoView& guess) const;

 private:
  using Matrix12d = Eigen::Matrix<double, 12, 12>;

  /// Moves `view` to the minimum over `unknowns` (6, or 12 with the motion between the stamps). Returns the
  /// information there, nothing if the observations do not determine it.
  std::optional<Matrix12d> minimise(const std::vector<MapObservation>& observations, const MotionPrior& prior,
                                    int unknowns, vision::StereoView& view) const;
  /// Errors and inliers at the estimated view. Returns the variance of the pixels, px^2.
  double judge(const std::vector<MapObservation>& observations, int unknowns, PoseEstimate& estimate) const;

  PoseEstimatorParams params_;
  vision::StereoCalibration calibration_;
};

}  // namespace stereo_nav::odometry
