#include "estimation/ekf/correction.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace stereo_nav::estimation {

bool weigh(const State& state, Innovation& innovation) {
  innovation.PHt.noalias() = state.covariance.lazyProduct(innovation.H.transpose());
  innovation.S = innovation.noise + innovation.H.lazyProduct(innovation.PHt);
  const Eigen::LLT<FieldMatrix> of_noise(innovation.noise);
  const Eigen::LLT<FieldMatrix> of_sum(innovation.S);
  if (of_noise.info() != Eigen::Success || of_sum.info() != Eigen::Success) return false;
  innovation.nis = innovation.residual.dot(of_sum.solve(innovation.residual));
  innovation.information = 0.0;
  for (Eigen::Index i = 0; i < innovation.residual.size(); ++i)
    innovation.information += std::log(of_sum.matrixLLT()(i, i) / of_noise.matrixLLT()(i, i));
  return std::isfinite(innovation.nis) && std::isfinite(innovation.information);
}

bool correct(const StateLayout& layout, const Innovation& innovation, State& state) {
  const Eigen::LLT<FieldMatrix> cholesky(innovation.S);
  if (cholesky.info() != Eigen::Success) return false;
  Eigen::MatrixXd K = cholesky.solve(innovation.PHt.transpose()).transpose();
  for (const int row : innovation.unmoved) K.row(row).setZero();
  const Eigen::MatrixXd W = innovation.PHt - 0.5 * K.lazyProduct(innovation.S);
  const Eigen::VectorXd shift = K * innovation.residual;
  const Eigen::MatrixXd half = 0.5 * state.covariance - W.lazyProduct(K.transpose());
  if (!shift.allFinite() || !half.allFinite()) return false;
  layout.add(shift, state);
  state.covariance = half + half.transpose();
  return true;
}

}  // namespace stereo_nav::estimation
