#include "estimation/ekf/state.h"

#include "stereo_nav/core/lie.h"

namespace stereo_nav::estimation {

StateLayout::StateLayout(const StateParts& parts) : anchors_(parts.anchors), planar_(parts.planar) {
  at_.assign(static_cast<std::size_t>(error_row::kAnchors + 6 * parts.anchors), -1);
  const auto keep = [this](int row) {
    at_[static_cast<std::size_t>(row)] = rows();
    rows_.push_back(row);
  };
  const auto keepLinear = [&](int first) {
    for (int axis = 0; axis < (parts.planar ? 2 : 3); ++axis) keep(first + axis);
  };
  const auto keepAngular = [&](int first) {
    for (int axis = parts.planar ? 2 : 0; axis < 3; ++axis) keep(first + axis);
  };
  keepLinear(error_row::kPosition);
  keepAngular(error_row::kRotation);
  keepLinear(error_row::kVelocity);
  keepAngular(error_row::kRate);
  if (parts.accelerometer) keepLinear(error_row::kAcceleration);
  moving_rows_ = rows();
  if (parts.gyro) keepAngular(error_row::kGyroBias);
  if (parts.accelerometer) keepLinear(error_row::kAccelerometerBias);
  if (parts.wheel_scales) {
    for (int i = 0; i < kWheelScales; ++i) {
      if (parts.wheel_turns || !isTurnByWay(kScalePlaces[static_cast<std::size_t>(i)]))
        keep(error_row::kScale + i);
    }
  }
  core_rows_ = rows();
  for (int anchor = 0; anchor < parts.anchors; ++anchor) {
    keepLinear(error_row::kAnchors + 6 * anchor);
    keepAngular(error_row::kAnchors + 6 * anchor + 3);
  }
}

void StateLayout::add(const Eigen::VectorXd& error, State& state) const {
  const auto part = [this, &error](int first) {
    Eigen::Vector3d three = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      if (at(first + i) >= 0) three[i] = error[at(first + i)];
    }
    return three;
  };
  const auto move = [&part](int row, Eigen::Isometry3d& T) {
    T.translation() += T.linear() * part(row);
    T.linear() =
        (Eigen::Quaterniond(T.linear()) * expQuaternion(part(row + 3))).normalized().toRotationMatrix();
  };
  move(error_row::kPosition, state.T_world_base);
  state.velocity += part(error_row::kVelocity);
  state.rate += part(error_row::kRate);
  state.acceleration += part(error_row::kAcceleration);
  state.gyro_bias += part(error_row::kGyroBias);
  state.accelerometer_bias += part(error_row::kAccelerometerBias);
  for (int i = 0; i < kWheelScales; ++i) {
    if (at(error_row::kScale + i) >= 0) state.wheel_scale[i] += error[at(error_row::kScale + i)];
  }
  for (std::size_t i = 0; i < state.anchors.size(); ++i)
    move(error_row::kAnchors + 6 * static_cast<int>(i), state.anchors[i]);
}

Eigen::MatrixXd StateLayout::covarianceOf(const State& state, int first_row, int rows) const {
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(rows, rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      if (at(first_row + i) >= 0 && at(first_row + j) >= 0)
        part(i, j) = state.covariance(at(first_row + i), at(first_row + j));
    }
  }
  return part;
}

void cloneAnchor(const StateLayout& layout, int anchor, const std::vector<int>& fields, State& state) {
  const int first = error_row::kAnchors + 6 * anchor;
  Eigen::Isometry3d& T_world_anchor = state.anchors[static_cast<std::size_t>(anchor)];
  const Eigen::Isometry3d T_anchor_base = T_world_anchor.inverse() * state.T_world_base;
  const Eigen::Vector3d turn = logRotation(Eigen::Matrix3d(T_anchor_base.linear()));
  Vector6d shift = Vector6d::Zero();
  for (const int field : fields) {
    shift[field] = field < 3 ? T_anchor_base.translation()[field] : turn[field - 3];
    const int to = layout.at(first + field);
    const int from = layout.at(error_row::kPosition + field);
    if (to < 0) continue;
    state.covariance.row(to) = state.covariance.row(from).eval();
    state.covariance.col(to) = state.covariance.col(from).eval();
  }
  if (fields.size() == 6) {
    T_world_anchor = state.T_world_base;
    return;
  }
  T_world_anchor.translation() += T_world_anchor.linear() * shift.head<3>();
  T_world_anchor.linear() = (T_world_anchor.linear() * expRotation(shift.tail<3>())).eval();
}

}  // namespace stereo_nav::estimation
