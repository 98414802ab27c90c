#pragma once

#include <Eigen/Cholesky>
#include <optional>

namespace stereo_nav {

/// The step to the minimum of a least-squares problem, linearised: information * step = -gradient, with the
/// information J^T W J and the gradient J^T W r of residuals (observed - projected) under left perturbations
/// T <- expMotion(delta) T. Only the lower triangle of the information is read. Nothing if the residuals do
/// not determine the step.
template <typename Matrix, typename Vector>
std::optional<Vector> gaussNewtonStep(const Eigen::LDLT<Matrix>& information, const Vector& gradient) {
  if (information.info() != Eigen::Success || !information.isPositive()) return std::nullopt;
  Vector step = information.solve(-gradient);
  if (!step.allFinite()) return std::nullopt;
  return step;
}

template <typename Matrix, typename Vector>
std::optional<Vector> gaussNewtonStep(const Matrix& information, const Vector& gradient) {
  return gaussNewtonStep(Eigen::LDLT<Matrix>(information), gradient);
}

}  // namespace stereo_nav
