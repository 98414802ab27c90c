#include "estimation/ekf/observation.h"

#include <cmath>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"

namespace stereo_nav::estimation {
namespace {

using namespace error_row;
using Kind = Measurement::Kind;

/// d (roll, pitch, yaw) / d phi, for an error phi about the axes of the body.
Eigen::Matrix3d rpyJacobian(const RollPitchYaw& rpy) {
  const double sr = std::sin(rpy.roll), cr = std::cos(rpy.roll);
  const double cp = std::cos(rpy.pitch), tp = std::tan(rpy.pitch);
  Eigen::Matrix3d J;
  J << 1.0, sr * tp, cr * tp, 0.0, cr, -sr, 0.0, sr / cp, cr / cp;
  return J;
}

/// A measurement of all six fields, before those that count are picked.
struct Whole {
  Vector6d residual = Vector6d::Zero();
  /// By the rows of the error that are no anchor's, and by those of the anchor that it is about.
  Eigen::Matrix<double, 6, kAnchors> H = Eigen::Matrix<double, 6, kAnchors>::Zero();
  int anchor_row = -1;  ///< first row of that anchor; -1: none
  Matrix6d H_anchor = Matrix6d::Zero();
};

void observePose(const State& state, const Measurement& measurement, Whole& whole) {
  const Eigen::Matrix3d R = state.T_world_base.linear();
  const RollPitchYaw estimated = RollPitchYaw::of(R);
  const RollPitchYaw measured = RollPitchYaw::of(measurement.pose.linear());
  whole.residual.head<3>() = measurement.pose.translation() - state.T_world_base.translation();
  whole.residual.tail<3>() << wrapRadians(measured.roll - estimated.roll),
      wrapRadians(measured.pitch - estimated.pitch), wrapRadians(measured.yaw - estimated.yaw);
  whole.H.block<3, 3>(0, kPosition) = R;
  whole.H.block<3, 3>(3, kRotation) = rpyJacobian(estimated);
}

/// z = (I + A)^-1 v; a unit of the scale in row i and column j changes it by minus column i of the inverse
/// times z_j.
void observeWheels(const State& state, Whole& whole) {
  const Eigen::Matrix3d inverse = matrixOf(state.wheel_scale).inverse();
  const Eigen::Vector3d expected =
      inverse * Eigen::Vector3d(state.velocity.x(), state.velocity.y(), state.rate.z());
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = kPlanarFields[i];
    const auto axis = static_cast<Eigen::Index>(i);
    whole.residual[row] = expected[axis];
    for (std::size_t j = 0; j < 3; ++j)
      whole.H(row, kVelocity + kPlanarFields[j]) = inverse(axis, static_cast<Eigen::Index>(j));
    for (std::size_t k = 0; k < kScalePlaces.size(); ++k) {
      if (!state.scale_held[k])
        whole.H(row, kScale + static_cast<int>(k)) =
            -inverse(axis, kScalePlaces[k].axis) * expected[kScalePlaces[k].of];
    }
  }
}

void observeTwist(const State& state, const Measurement& measurement, bool wheels, Whole& whole) {
  whole.residual << state.velocity, state.rate;
  whole.H.block<6, 6>(0, kVelocity).setIdentity();
  if (wheels) observeWheels(state, whole);
  whole.residual = (measurement.value - whole.residual).eval();
}

void observeRate(const State& state, const Measurement& measurement, Whole& whole) {
  whole.residual.tail<3>() = measurement.value.tail<3>() - state.rate - state.gyro_bias;
  whole.H.block<3, 3>(3, kRate).setIdentity();
  whole.H.block<3, 3>(3, kGyroBias).setIdentity();
}

/// f = dv/dt + omega x v + omega x (omega x r) + R^T (0 0 g) + bias, the velocity being that in the body's
/// axes.
void observeAcceleration(const State& state, const Measurement& measurement, double gravity_m_s2,
                         Whole& whole) {
  const Eigen::Vector3d up =
      state.T_world_base.linear().transpose() * Eigen::Vector3d(0.0, 0.0, gravity_m_s2);
  const Eigen::Vector3d& r = measurement.p_base_sensor;
  const Eigen::Vector3d at_sensor = state.velocity + state.rate.cross(r);
  whole.residual.head<3>() = measurement.value.head<3>() - state.acceleration - state.rate.cross(at_sensor) -
                             up - state.accelerometer_bias;
  whole.H.block<3, 3>(0, kRotation) = hat(up);
  whole.H.block<3, 3>(0, kVelocity) = hat(state.rate);
  whole.H.block<3, 3>(0, kRate) = -hat(at_sensor) - hat(state.rate) * hat(r);
  whole.H.block<3, 3>(0, kAcceleration).setIdentity();
  whole.H.block<3, 3>(0, kAccelerometerBias).setIdentity();
}

int stateRowOf(Kind kind, int field) {
  switch (kind) {
    case Kind::kPose:
    case Kind::kMotion:
      return kPosition + field;
    case Kind::kAcceleration:
      return kAcceleration + field;
    case Kind::kTwist:
    case Kind::kRate:
      break;
  }
  return kVelocity + field;
}

Innovation picked(const StateLayout& layout, const Whole& whole, const Matrix6d& covariance,
                  const std::vector<int>& fields) {
  const auto n = static_cast<Eigen::Index>(fields.size());
  Innovation innovation;
  innovation.fields = fields;
  innovation.residual.resize(n);
  innovation.noise.resize(n, n);
  innovation.H.setZero(n, layout.rows());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int field = fields[static_cast<std::size_t>(i)];
    innovation.residual[i] = whole.residual[field];
    for (int j = 0; j < layout.coreRows(); ++j)
      innovation.H(i, j) = whole.H(field, layout.kept()[static_cast<std::size_t>(j)]);
    for (int j = 0; whole.anchor_row >= 0 && j < 6; ++j) {
      const int column = layout.at(whole.anchor_row + j);
      if (column >= 0) innovation.H(i, column) = whole.H_anchor(field, j);
    }
    for (Eigen::Index j = 0; j < n; ++j)
      innovation.noise(i, j) = covariance(field, fields[static_cast<std::size_t>(j)]);
  }
  return innovation;
}

}  // namespace

Innovation observe(const StateLayout& layout, const State& state, const Measurement& measurement, bool wheels,
                   double gravity_m_s2) {
  Whole whole;
  if (measurement.kind == Kind::kPose) observePose(state, measurement, whole);
  if (measurement.kind == Kind::kTwist) observeTwist(state, measurement, wheels, whole);
  if (measurement.kind == Kind::kRate) observeRate(state, measurement, whole);
  if (measurement.kind == Kind::kAcceleration) observeAcceleration(state, measurement, gravity_m_s2, whole);
  std::vector<int> fields;
  for (const int field : measurement.fields) {
    if (layout.at(stateRowOf(measurement.kind, field)) >= 0) fields.push_back(field);
  }
  return picked(layout, whole, measurement.covariance, fields);
}

Innovation observeAnchor(const StateLayout& layout, const State& state, int anchor,
                         const std::vector<int>& fields, const Vector6d& variances) {
  const int first = kAnchors + 6 * anchor;
  const Eigen::Isometry3d T_anchor_base =
      state.anchors[static_cast<std::size_t>(anchor)].inverse() * state.T_world_base;
  const Eigen::Matrix3d R = T_anchor_base.linear();
  Whole whole;
  whole.anchor_row = first;
  whole.residual << -T_anchor_base.translation(), -logRotation(R);
  whole.H.block<3, 3>(0, kPosition) = R;
  whole.H.block<3, 3>(3, kRotation).setIdentity();
  whole.H_anchor.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
  whole.H_anchor.block<3, 3>(0, 3) = hat(T_anchor_base.translation());
  whole.H_anchor.block<3, 3>(3, 3) = -R.transpose();
  std::vector<int> kept;
  for (const int field : fields) {
    if (layout.at(first + field) >= 0) kept.push_back(field);
  }
  return picked(layout, whole, variances.asDiagonal(), kept);
}

Eigen::Isometry3d scaled(const Eigen::Isometry3d& motion, const WheelScales& wheel_scale) {
  Vector6d twist = logMotion(motion);
  const Eigen::Vector3d planar = matrixOf(wheel_scale) * Eigen::Vector3d(twist[0], twist[1], twist[5]);
  twist.head<2>() = planar.head<2>();
  twist[5] = planar.z();
  return expMotion(twist);
}

void moveAnchor(const StateLayout& layout, int anchor, const Eigen::Isometry3d& motion,
                const Matrix6d& covariance, bool wheels, State& state) {
  const Eigen::Isometry3d corrected = wheels ? scaled(motion, state.wheel_scale) : motion;
  const Matrix6d carried = adjoint(corrected.inverse());
  const Vector6d twist = logMotion(motion);
  const int first = kAnchors + 6 * anchor;
  std::vector<int> rows;
  for (int field = 0; field < 6; ++field) {
    if (layout.at(first + field) >= 0) rows.push_back(field);
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  // What takes the whole error to that of the anchor after the motion.
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, layout.rows());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int field = rows[static_cast<std::size_t>(i)];
    for (const int other : rows) L(i, layout.at(first + other)) = carried(field, other);
    for (std::size_t k = 0; wheels && k < kScalePlaces.size(); ++k) {
      const int column = layout.at(kScale + static_cast<int>(k));
      if (column >= 0 && kPlanarFields[static_cast<std::size_t>(kScalePlaces[k].axis)] == field)
        L(i, column) = twist[kPlanarFields[static_cast<std::size_t>(kScalePlaces[k].of)]];
    }
  }
  const Eigen::MatrixXd across = L * state.covariance;
  const Eigen::MatrixXd own = across * L.transpose();
  for (Eigen::Index i = 0; i < n; ++i) {
    const int row = layout.at(first + rows[static_cast<std::size_t>(i)]);
    state.covariance.row(row) = across.row(i);
    state.covariance.col(row) = across.row(i).transpose();
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const int a = rows[static_cast<std::size_t>(i)], b = rows[static_cast<std::size_t>(j)];
      state.covariance(layout.at(first + a), layout.at(first + b)) = own(i, j) + covariance(a, b);
    }
  }
  Eigen::Isometry3d& T_world_anchor = state.anchors[static_cast<std::size_t>(anchor)];
  T_world_anchor = renormalised(T_world_anchor * corrected);
}

}  // namespace stereo_nav::estimation
