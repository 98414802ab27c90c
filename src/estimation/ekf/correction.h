#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/ekf/state.h"

namespace stereo_nav::estimation {

/// Of one measurement, which has up to six fields: no memory is allocated.
using FieldVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;
using FieldMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// A measurement against a state, in first order: residual = H error + noise.
struct Innovation {
  FieldVector residual;
  Eigen::MatrixXd H;         ///< columns: the kept rows of the error
  FieldMatrix noise;         ///< covariance
  std::vector<int> fields;   ///< of the measurement, row by row
  std::vector<int> unmoved;  ///< kept rows that are considered, but not corrected (Schmidt 1966)
  Eigen::MatrixXd PHt;       ///< covariance of state and residual; weigh() fills it, and what follows
  FieldMatrix S;             ///< covariance of the residual
  double nis = 0.0;          ///< normalised innovation squared
  double information = 0.0;  ///< what the measurement tells, in nats: log(|S| / |noise|) / 2
};

/// Fills the rest by S = H P H^T + noise; returns false where S or the noise is not positive definite.
bool weigh(const State& state, Innovation& innovation);

/// Kalman correction by a weighed innovation in Joseph's form, P = (I - K H) P (I - K H)^T + K R K^T, which
/// keeps the covariance positive whatever the gain's rounding (Bucy and Joseph 1968). Written out it is P - W
/// K^T - K W^T with W = P H^T - K S / 2, which is symmetric by construction and takes narrow products alone.
/// Returns false, and changes nothing, where the result would not be finite.
bool correct(const StateLayout& layout, const Innovation& innovation, State& state);

}  // namespace stereo_nav::estimation
