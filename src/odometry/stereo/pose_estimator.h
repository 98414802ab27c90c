#pragma once

#include <cmath>
#include <optional>
#include <vector>

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
  bool votes = true;  ///< otherwise only judged by the motion that the others have
};

/// What is known of a frame's motion before its features are looked at.
struct MotionPrior {
  Eigen::Isometry3d T_previous_world = Eigen::Isometry3d::Identity();
  /// Rotation since the previous frame from the IMU, previous camera -> camera, and its sigma per axis.
  std::optional<Eigen::Matrix3d> R_camera_previous;
  double rotation_sigma_rad = 1.0;

  double skew_s = 0.0;      ///< right stamp minus left stamp; 0 leaves T_late_camera at identity
  double interval_s = 0.0;  ///< since the previous frame
  /// Twist of the world in the camera frame (m/s, rad/s) at the previous frame, if it is known.
  std::optional<Vector6d> previous_twist;
  Vector6d twist_sigma = Vector6d::Ones();  ///< of the twist predicted from previous_twist and this motion
  std::optional<Eigen::Matrix3d> R_late_camera;  ///< rotation between the stamps from the IMU

  /// How well the motion between the stamps is known before the right image is looked at: m, rad.
  Vector6d lateSigma() const {
    Vector6d sigma = twist_sigma * std::abs(skew_s);
    if (R_late_camera) sigma.tail<3>().setConstant(rotation_sigma_rad);
    return sigma;
  }
};

/// What PoseEstimator found; not to be used unless `converged`.
struct PoseEstimate {
  vision::StereoView view;
  Matrix6d covariance = Matrix6d::Zero();  ///< of the left perturbation of T_camera_world: m, rad
  std::vector<double> error_px;            ///< per observation: the larger one of left and right
  std::vector<bool> inlier;                ///< error_px at most max_error_px
  std::size_t inliers = 0;
  double rms_px = 0.0;  ///< per coordinate, over the inliers
  bool converged = false;
};

/// Motion-only estimation against known points: Gauss-Newton with a Cauchy loss on the pixels of the left and
/// the right image, each at its own time. With skewed stamps the motion between them is estimated along with
/// the pose; a prior of constant acceleration ties the two together.
class PoseEstimator {
 public:
  PoseEstimator(const PoseEstimatorParams& params, const vision::StereoCalibration& calibration)
      : params_(params), calibration_(calibration) {}

  PoseEstimate estimate(const std::vector<MapObservation>& observations, const MotionPrior& prior,
                        const vision::StereoView& guess) const;

 private:
  PoseEstimatorParams params_;
  vision::StereoCalibration calibration_;
};

/// Twist at the right stamp's side of a motion, constant acceleration assumed: the mean twist since the
/// previous frame, extrapolated from the twist there (conditional mean of a Gauss-Markov velocity; Barfoot,
/// Tong and Sarkka 2014). Without a previous twist: the mean.
Vector6d extrapolatedTwist(const Eigen::Isometry3d& T_camera_previous, double interval_s,
                           const std::optional<Vector6d>& previous_twist);

}  // namespace stereo_nav::odometry
