#include "odometry/laser/told_directions.h"

#include <Eigen/Eigenvalues>

namespace stereo_nav::odometry {

ToldDirections toldDirections(const ScanInformation& information, double least_share) {
  ToldDirections result;
  if (!(information.weight > 0.0)) {
    result.projection.setZero();
    result.basis.resize(3, 0);
    result.parts.resize(0, 3);
    for (Eigen::Index i = 0; i < 3; ++i) result.untold.push_back(Eigen::Vector3d::Unit(i));
    return result;
  }
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / information.lever_m);
  const Eigen::Matrix3d shares =
      scale.asDiagonal() * (information.told - information.feigned) * scale.asDiagonal() / information.weight;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(shares);
  result.least_share = solver.eigenvalues()(0);
  Eigen::Index untold = 0;
  while (untold < 3 && solver.eigenvalues()(untold) < least_share)
    result.untold.push_back(solver.eigenvectors().col(untold++));
  result.basis = scale.asDiagonal() * solver.eigenvectors().rightCols(3 - untold);
  result.parts = solver.eigenvectors().rightCols(3 - untold).transpose() * scale.cwiseInverse().asDiagonal();
  result.projection = result.basis * result.parts;
  return result;
}

}  // namespace stereo_nav::odometry
