#include "mapping/mono/joint_covariance.h"

#include <Eigen/Cholesky>
#include <stdexcept>

namespace stereo_nav::mapping {

void JointCovariance::start(const Eigen::MatrixXd& camera) {
  size_ = camera.rows();
  used() = camera;
}

void JointCovariance::append(const Eigen::MatrixXd& by_camera, const Eigen::MatrixXd& noise) {
  const Index rows = by_camera.rows();
  const Index camera = by_camera.cols();
  if (size_ + rows > capacity()) throw std::logic_error("JointCovariance::append(): the capacity is used up");
  const Eigen::MatrixXd cross = by_camera * P_.topLeftCorner(camera, size_);
  P_.block(size_, 0, rows, size_) = cross;
  P_.block(0, size_, size_, rows) = cross.transpose();
  const Eigen::MatrixXd own = cross.leftCols(camera) * by_camera.transpose() + noise;
  P_.block(size_, size_, rows, rows) = 0.5 * (own + own.transpose());
  size_ += rows;
}

void JointCovariance::remove(Index offset, Index length) {
  const Index after = size_ - offset - length;
  // Column by column, in the direction of the way: no copy of the matrix is needed.
  for (Index column = 0; column < size_; ++column) {
    for (Index row = 0; row < after; ++row) P_(offset + row, column) = P_(offset + length + row, column);
  }
  size_ -= length;
  for (Index column = 0; column < after; ++column)
    P_.col(offset + column).head(size_) = P_.col(offset + length + column).head(size_);
}

void JointCovariance::replace(Index offset, const Eigen::MatrixXd& by_block) {
  const Index rows = by_block.rows();
  const Index block = by_block.cols();
  const Eigen::MatrixXd own = by_block * P_.block(offset, offset, block, block) * by_block.transpose();
  const Eigen::MatrixXd cross = by_block * P_.block(offset, 0, block, size_);
  P_.block(offset, 0, rows, size_) = cross;
  P_.block(0, offset, size_, rows) = cross.transpose();
  P_.block(offset, offset, rows, rows) = 0.5 * (own + own.transpose());
  remove(offset + rows, block - rows);
}

void JointCovariance::moveCamera(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise) {
  const Index camera = transition.rows();
  const Index others = size_ - camera;
  const Eigen::MatrixXd own = transition * P_.topLeftCorner(camera, camera) * transition.transpose() + noise;
  P_.topLeftCorner(camera, camera) = 0.5 * (own + own.transpose());
  const Eigen::MatrixXd cross = P_.block(camera, 0, others, camera) * transition.transpose();
  P_.block(camera, 0, others, camera) = cross;
  P_.block(0, camera, camera, others) = cross.transpose();
}

Eigen::VectorXd JointCovariance::update(const Eigen::MatrixXd& PHt, const Eigen::MatrixXd& S,
                                        const Eigen::VectorXd& innovation) {
  const Eigen::LLT<Eigen::MatrixXd> factor(S);  // S = L L^T
  if (factor.info() != Eigen::Success) return {};
  // With W = P H^T L^-T the gain is W L^-1, and what the covariance loses W W^T.
  Eigen::MatrixXd W = PHt;
  factor.matrixU().solveInPlace<Eigen::OnTheRight>(W);
  Eigen::VectorXd step = W * factor.matrixL().solve(innovation);
  auto P = used();
  P.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0);
  P.triangularView<Eigen::StrictlyUpper>() = P.transpose();
  return step;
}

}  // namespace stereo_nav::mapping
