#include "estimation/ekf/correction.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace stereo_nav::estimation {

bool weigh(const State& state, Innovation& innovation) {
  const Eigen::LLT<Eigen::MatrixXd> of_noise(innovation.noise);
  const Eigen::LLT<Eigen::MatrixXd> of_sum(innovation.H * state.covariance * innovation.H.transpose() +
                                           innovation.noise);
  if (of_noise.info() != Eigen::Success || of_sum.info() != Eigen::Success) return false;
  innovation.nis = innovation.residual.dot(of_sum.solve(innovation.residual));
  innovation.information = 0.0;
  for (Eigen::Index i = 0; i < innovation.residual.size(); ++i)
    innovation.information += std::log(of_sum.matrixL()(i, i) / of_noise.matrixL()(i, i));
  return std::isfinite(innovation.nis) && std::isfinite(innovation.information);
}

bool correct(const StateLayout& layout, const Innovation& innovation, State& state) {
  const Eigen::MatrixXd S = innovation.H * state.covariance * innovation.H.transpose() + innovation.noise;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(S);
  if (cholesky.info() != Eigen::Success) return false;
  const Eigen::MatrixXd K = cholesky.solve(innovation.H * state.covariance.transpose()).transpose();
  const Eigen::VectorXd shift = K * innovation.residual;
  Eigen::MatrixXd P = state.covariance - K * (innovation.H * state.covariance);
  P -= (P * innovation.H.transpose()).eval() * K.transpose();
  P.noalias() += K * innovation.noise * K.transpose();
  if (!shift.allFinite() || !P.allFinite()) return false;
  layout.add(shift, state);
  state.covariance = 0.5 * (P + P.transpose());
  return true;
}

}  // namespace stereo_nav::estimation
