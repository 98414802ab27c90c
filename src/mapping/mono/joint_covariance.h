#pragma once

#include <Eigen/Core>

namespace stereo_nav::mapping {

/// The covariance of the camera, which comes first, and of all that was appended to it. Memory is taken once,
/// for `capacity` rows; the matrix stays symmetric to the last bit.
class JointCovariance {
 public:
  using Index = Eigen::Index;

  explicit JointCovariance(Index capacity) : P_(Eigen::MatrixXd::Zero(capacity, capacity)) {}

  Index size() const { return size_; }
  Index capacity() const { return P_.rows(); }
  auto matrix() const { return P_.topLeftCorner(size_, size_); }

  /// Forgets everything but the camera.
  void start(const Eigen::MatrixXd& camera);

  /// Appends y = f(camera) + noise. `by_camera` is df / d camera.
  void append(const Eigen::MatrixXd& by_camera, const Eigen::MatrixXd& noise);

  /// Leaves out `length` rows and columns from `offset` on.
  void remove(Index offset, Index length);

  /// Puts y = f(old block), of fewer rows, in the place of the block at `offset`; `by_block` is df / d block.
  void replace(Index offset, const Eigen::MatrixXd& by_block);

  /// The camera moves: camera' = transition * camera + noise.
  void moveCamera(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& noise);

  /// The correction of a Kalman filter by a measurement of m numbers: `PHt` (size x m) is P H^T, `S` (m x m)
  /// the covariance of the innovation. P becomes P - P H^T S^-1 H P. Returns the step of the state, or
  /// nothing (an empty vector) when S is not positive definite.
  Eigen::VectorXd update(const Eigen::MatrixXd& PHt, const Eigen::MatrixXd& S,
                         const Eigen::VectorXd& innovation);

 private:
  auto used() { return P_.topLeftCorner(size_, size_); }

  Eigen::MatrixXd P_;
  Index size_ = 0;
};

}  // namespace stereo_nav::mapping
