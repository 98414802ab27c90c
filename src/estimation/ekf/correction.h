#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "estimation/ekf/state.h"

namespace stereo_nav::estimation {

/// A measurement against a state, in first order: residual = H error + noise.
struct Innovation {
  Eigen::VectorXd residual;
  Eigen::MatrixXd H;         ///< columns: the kept rows of the error
  Eigen::MatrixXd noise;     ///< covariance
  std::vector<int> fields;   ///< of the measurement, row by row
  double nis = 0.0;          ///< normalised innovation squared
  double information = 0.0;  ///< what the measurement tells, in nats: log(|S| / |noise|) / 2
};

/// Fills `nis` and `information` by S = H P H^T + noise; returns false where S or the noise is not positive
/// definite.
bool weigh(const State& state, Innovation& innovation);

/// Kalman correction in Joseph's form, P = (I - K H) P (I - K H)^T + K R K^T, which keeps the covariance
/// symmetric and positive whatever the gain's rounding (Bucy and Joseph 1968). Two narrow products instead of
/// two square ones. Returns false, and changes nothing, where the result would not be finite.
bool correct(const StateLayout& layout, const Innovation& innovation, State& state);

}  // namespace stereo_nav::estimation
