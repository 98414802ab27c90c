#include "estimation/ekf/prediction.h"

#include <algorithm>
#include <cmath>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kLongestStep_s = 0.05;
constexpr int kMoving = error_row::kGyroBias;
using CoreVector = Eigen::Matrix<double, error_row::kAnchors, 1>;

/// What an acceleration that dies away adds to velocity and way after some time.
struct Decay {
  double left, velocity_s, way_s2;
};

Decay decayAfter(double step_s, double decay_s) {
  const double left = std::exp(-step_s / decay_s);
  const double velocity_s = -decay_s * std::expm1(-step_s / decay_s);
  return {left, velocity_s, decay_s * (step_s - velocity_s)};
}

Eigen::Isometry3d motionIn(const State& state, double step_s, const Decay& decay) {
  Vector6d twist;
  twist << state.velocity * step_s + state.acceleration * decay.way_s2, state.rate * step_s;
  return expMotion(twist);
}

CoreVector densities(const ProcessNoise& noise) {
  CoreVector q;
  q << noise.position, noise.rotation, noise.velocity, noise.rate, noise.acceleration, noise.gyro_bias,
      noise.accelerometer_bias, noise.wheel_scale;
  return q;
}

/// The rows that move of a transition or of its noise, of what the layout keeps: no memory is allocated.
using MovingRows =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMoving, error_row::kAnchors>;

MovingRows keptTransition(const StateLayout& layout, const Transition& F) {
  MovingRows kept(layout.movingRows(), layout.coreRows());
  for (int j = 0; j < kept.cols(); ++j) {
    for (int i = 0; i < kept.rows(); ++i)
      kept(i, j) = F(layout.kept()[static_cast<std::size_t>(i)], layout.kept()[static_cast<std::size_t>(j)]);
  }
  return kept;
}

/// Integral of F(s) Q F(s)^T over the step, of the rows that move.
MovingRows integratedNoise(const StateLayout& layout, const CoreVector& densities, const ProcessNoise& noise,
                           const State& state, double step_s) {
  const double outer = 0.5 * std::sqrt(0.6);
  const double places[3] = {0.5 - outer, 0.5, 0.5 + outer};
  const double weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const int m = layout.movingRows(), n = layout.coreRows();
  MovingRows sum = MovingRows::Zero(m, n);
  for (int i = 0; i < 3; ++i) {
    const MovingRows F =
        keptTransition(layout, transitionOf(state, places[i] * step_s, noise.acceleration_decay_s));
    const MovingRows FQ = F * (weights[i] * step_s * densities.head(n)).asDiagonal();
    sum.leftCols(m) += FQ.lazyProduct(F.transpose());
    sum.rightCols(n - m) += FQ.rightCols(n - m);
  }
  return sum;
}

/// F P F^T + Q for F = (F_moving; 0 I), whose lower rows are those that stay.
void propagate(const StateLayout& layout, const MovingRows& F, const MovingRows& noise, Eigen::MatrixXd& P) {
  const int m = layout.movingRows(), n = layout.coreRows(), rest = layout.rows() - m;
  const MovingRows FP = F.lazyProduct(P.topLeftCorner(n, n));
  if (layout.rows() > n)
    P.topRightCorner(m, layout.rows() - n) = F.lazyProduct(P.topRightCorner(n, layout.rows() - n)).eval();
  P.block(0, m, m, n - m) = FP.rightCols(n - m) + noise.rightCols(n - m);
  P.bottomLeftCorner(rest, m) = P.topRightCorner(m, rest).transpose();
  const MovingRows own = FP.lazyProduct(F.transpose()) + noise.leftCols(m);
  P.topLeftCorner(m, m) = 0.5 * (own + own.transpose());
}

void step(const StateLayout& layout, const ProcessNoise& noise, double step_s, State& state) {
  const int m = layout.movingRows(), n = layout.coreRows();
  const CoreVector whole = densities(noise);
  CoreVector kept = CoreVector::Zero();
  for (int i = 0; i < n; ++i) kept[i] = whole[layout.kept()[static_cast<std::size_t>(i)]];
  propagate(layout, keptTransition(layout, transitionOf(state, step_s, noise.acceleration_decay_s)),
            integratedNoise(layout, kept, noise, state, step_s), state.covariance);
  for (int i = m; i < n; ++i) state.covariance(i, i) += step_s * kept[i];
  const Decay decay = decayAfter(step_s, noise.acceleration_decay_s);
  state.T_world_base = renormalised(state.T_world_base * motionIn(state, step_s, decay));
  state.velocity += decay.velocity_s * state.acceleration;
  state.acceleration *= decay.left;
  state.time_s += step_s;
}

}  // namespace

WheelScales velocityByScale(const State& state) {
  const Eigen::Vector3d twist(state.velocity.x(), state.velocity.y(), state.rate.z());
  const Eigen::Vector3d of_wheels = matrixOf(state.wheel_scale).inverse() * twist;
  WheelScales by_scale = WheelScales::Zero();
  for (int i = 0; i < kWheelScales; ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (state.scale_held[index]) by_scale[i] = of_wheels[kScalePlaces[index].of];
  }
  return by_scale;
}

Transition transitionOf(const State& state, double step_s, double acceleration_decay_s) {
  using namespace error_row;
  const Decay decay = decayAfter(step_s, acceleration_decay_s);
  Transition F = Transition::Identity();
  F.block<6, 6>(kPosition, kPosition) = adjoint(motionIn(state, step_s, decay).inverse());
  const Eigen::Matrix3d turning = step_s * (Eigen::Matrix3d::Identity() - 0.5 * step_s * hat(state.rate));
  F.block<3, 3>(kPosition, kVelocity) = turning;
  F.block<3, 3>(kRotation, kRate) = turning;
  F.block<3, 3>(kPosition, kRate) = -0.5 * step_s * step_s * hat(state.velocity);
  F.block<3, 3>(kPosition, kAcceleration) = decay.way_s2 * Eigen::Matrix3d::Identity();
  F.block<3, 3>(kVelocity, kAcceleration) = decay.velocity_s * Eigen::Matrix3d::Identity();
  F.block<3, 3>(kAcceleration, kAcceleration) = decay.left * Eigen::Matrix3d::Identity();
  const int moved[3] = {kPosition, kPosition + 1, kRotation + 2};
  const WheelScales by_scale = velocityByScale(state);
  for (int i = 0; i < kWheelScales; ++i)
    F(moved[kScalePlaces[static_cast<std::size_t>(i)].axis], kScale + i) = step_s * by_scale[i];
  return F;
}

void predict(const StateLayout& layout, const ProcessNoise& noise, double time_s, State& state) {
  const double duration_s = time_s - state.time_s;
  if (duration_s <= 0.0) return;
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / kLongestStep_s)));
  for (int i = 0; i < steps; ++i) step(layout, noise, duration_s / steps, state);
  state.time_s = time_s;
}

}  // namespace stereo_nav::estimation
