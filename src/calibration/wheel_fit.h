#pragma once

#include <vector>

#include "calibration/wheel_calibration.h"

namespace stereo_nav::calibration {

/// The least-squares problem of calibrateWheels(). Its unknowns are normalised by what is assumed of them:
/// relative radius, x, y and direction of each wheel, then the reference's scale, then the lateness of each
/// run's stamps.
class WheelFit {
 public:
  WheelFit(const WheelWindows& windows, const odometry::WheelOdometryParams& nominal, std::size_t runs,
           const WheelCalibrationParams& params);

  /// Weights the windows with the errors of these parameters.
  void setErrors(const odometry::WheelOdometryParams& errors);
  /// Finds the unknowns, from the last ones on.
  void solve();

  kinematics::DriveParams drive() const { return driveOf(unknowns_); }
  double referenceScale() const;
  double timeOffset_s(std::size_t run) const;
  /// Of the wheels' unknowns in their units: relative, m, m, rad for each wheel.
  Eigen::MatrixXd wheelCovariance() const;
  /// Mean of the squares of the normalised errors over `windows`, 1 is expected; with the errors of `params`.
  double meanSquare(const WheelWindows& windows, const odometry::WheelOdometryParams& params) const;
  WheelAgreement agreement(bool nominal) const;

 private:
  kinematics::DriveParams driveOf(const Eigen::VectorXd& unknowns) const;
  Eigen::Vector3d error(const WheelWindows& windows, const WheelWindows::Window& window,
                        const WheelWindows::Motion& by_wheels, const Eigen::VectorXd& unknowns) const;
  Eigen::Matrix3d covariance(const WheelWindows& windows, const WheelWindows::Window& window,
                             const odometry::WheelOdometryParams& errors) const;
  std::vector<Eigen::VectorXd> whitened(const Eigen::VectorXd& unknowns) const;
  double cost(const Eigen::VectorXd& unknowns) const;
  void linearise(Eigen::MatrixXd& information, Eigen::VectorXd& gradient) const;

  const WheelWindows& windows_;
  odometry::WheelOdometryParams nominal_;
  odometry::WheelOdometryParams errors_;  ///< with which the windows are weighted
  WheelCalibrationParams params_;
  Eigen::VectorXd sigmas_;    ///< what is assumed of each unknown
  Eigen::VectorXd unknowns_;  ///< in units of these
  Eigen::MatrixXd covariance_;
  std::vector<Eigen::Matrix3d> whitening_;  ///< of each window
};

}  // namespace stereo_nav::calibration
