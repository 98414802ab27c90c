#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "estimation/ekf/wheel_scales.h"

namespace stereo_nav::estimation {

/// First row of each part of the error of a state. A pose's error is that of its translation, then of its
/// rotation, both in its own axes: p = p_estimated + R_estimated rho, R = R_estimated exp(phi).
namespace error_row {
constexpr int kPosition = 0;
constexpr int kRotation = 3;
constexpr int kVelocity = 6;
constexpr int kRate = 9;
constexpr int kAcceleration = 12;
constexpr int kGyroBias = 15;
constexpr int kAccelerometerBias = 18;
constexpr int kScale = 21;
constexpr int kAnchors = kScale + kWheelScales;  ///< six rows for each anchor from here on
}  // namespace error_row

/// What the filter estimates. Velocities, rates and accelerations have the axes of base_link.
struct State {
  double time_s = 0.0;
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            ///< m/s
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();                ///< rad/s
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();        ///< d velocity / dt, m/s^2
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();           ///< rad/s, axes of base_link
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< m/s^2, axes of base_link
  WheelScales wheel_scale = WheelScales::Zero();
  /// Held scales are not estimated, but considered (Schmidt 1966): the error of the velocity is then the
  /// wheels' own, without the scale's, which enters the pose as it moves.
  std::array<bool, kWheelScales> scale_held{};
  /// Cloned poses, one for each odometry: where base_link was at its last message.
  std::vector<Eigen::Isometry3d> anchors;
  Eigen::MatrixXd covariance;  ///< of the rows that StateLayout keeps
};

/// Which parts of a state are estimated.
struct StateParts {
  bool planar = false;         ///< x, y and yaw alone
  bool gyro = false;           ///< with a gyroscope's bias
  bool accelerometer = false;  ///< with the acceleration and an accelerometer's bias
  bool wheel_scales = false;   ///< forward, left, turning, and the drift to the left
  bool wheel_turns = false;    ///< with the turns that grow with the way
  int anchors = 0;
};

/// Which rows of the error are estimated. The others are known to be zero and take no time.
class StateLayout {
 public:
  explicit StateLayout(const StateParts& parts);

  int rows() const { return static_cast<int>(rows_.size()); }
  /// The first rows: pose, velocities and accelerations, which change by themselves. The rows after them stay
  /// what they are, up to their noise.
  int movingRows() const { return moving_rows_; }
  /// Rows that are no anchor's.
  int coreRows() const { return core_rows_; }
  /// Kept row to row of the error.
  const std::vector<int>& kept() const { return rows_; }
  /// Row of the error to kept row; -1: not kept.
  int at(int error_row) const { return at_[static_cast<std::size_t>(error_row)]; }
  bool planar() const { return planar_; }
  int anchors() const { return anchors_; }

  /// Adds an error (kept rows) to a state.
  void add(const Eigen::VectorXd& error, State& state) const;
  /// The covariance of up to six rows of the error, zero where they are not kept.
  Eigen::MatrixXd covarianceOf(const State& state, int first_row, int rows) const;

 private:
  std::vector<int> rows_;
  std::vector<int> at_;
  int moving_rows_ = 0;
  int core_rows_ = 0;
  int anchors_ = 0;
  bool planar_ = false;
};

/// An anchor becomes the present pose, its error that of the pose, in the given of the six fields.
void cloneAnchor(const StateLayout& layout, int anchor, const std::vector<int>& fields, State& state);

}  // namespace stereo_nav::estimation
