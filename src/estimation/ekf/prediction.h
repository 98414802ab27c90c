#pragma once

#include "estimation/ekf/state.h"

namespace stereo_nav::estimation {

/// How fast the parts of a state become uncertain by themselves: variances a second.
struct ProcessNoise {
  Eigen::Vector3d position = Eigen::Vector3d::Constant(1e-6);            ///< m^2/s, axes of base_link
  Eigen::Vector3d rotation = Eigen::Vector3d::Constant(1e-8);            ///< rad^2/s
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(0.5);             ///< (m/s)^2/s
  Eigen::Vector3d rate = Eigen::Vector3d::Constant(1.0);                 ///< (rad/s)^2/s
  Eigen::Vector3d acceleration = Eigen::Vector3d::Constant(1.0);         ///< (m/s^2)^2/s
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Constant(1e-9);           ///< (rad/s)^2/s
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Constant(1e-6);  ///< (m/s^2)^2/s
  WheelScales wheel_scale = WheelScales::Constant(1e-7);                 ///< 1/s
  double acceleration_decay_s = 1.0;  ///< an acceleration that nothing measures dies away in this time
};

/// What a unit error of each held wheel scale is off by as a velocity along its axis; zero for those that are
/// not held. m/s or rad/s.
WheelScales velocityByScale(const State& state);

/// Rows: those of the error that change by themselves. Columns: those that are no anchor's.
using Transition = Eigen::Matrix<double, error_row::kGyroBias, error_row::kAnchors>;

/// Error at the end of a step of `step_s` for a unit error of each core row at its start: rho' = -omega x rho
/// - v x phi + dv, phi' = -omega x phi + domega (Sola et al. 2018, "A micro Lie theory", with the error on
/// the right).
Transition transitionOf(const State& state, double step_s, double acceleration_decay_s);

/// Moves a state on to `time_s`, in steps of 0.05 s at most: velocities stay, accelerations die away. The
/// noise is integrated over each step by three-point Gauss-Legendre quadrature of F(s) Q F(s)^T, which is
/// exact for polynomials of fifth order: the result does not depend on how the time is divided.
void predict(const StateLayout& layout, const ProcessNoise& noise, double time_s, State& state);

}  // namespace stereo_nav::estimation
