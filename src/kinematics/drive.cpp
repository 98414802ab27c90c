#include "kinematics/drive.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::kinematics {
namespace {

constexpr double kRankThreshold = 1e-9;
constexpr double kSameAxle = 0.02;  // fixed wheels that differ by less, as measured ones do, are on one axle

Eigen::RowVector3d along(double direction_rad, const WheelParams& wheel) {
  const double c = std::cos(direction_rad);
  const double s = std::sin(direction_rad);
  return {c, s, s * wheel.x_m - c * wheel.y_m};
}

/// Projection onto the twists that none of the rows sees.
Eigen::Matrix3d nullSpaceProjection(const Eigen::MatrixX3d& rows) {
  if (rows.rows() == 0) return Eigen::Matrix3d::Identity();
  const Eigen::JacobiSVD<Eigen::MatrixX3d> svd(rows, Eigen::ComputeFullV);
  Eigen::Matrix3d projection = Eigen::Matrix3d::Identity();
  for (Eigen::Index i = 0; i < svd.singularValues().size(); ++i) {
    if (svd.singularValues()(i) < kSameAxle * svd.singularValues()(0)) continue;
    projection -= svd.matrixV().col(i) * svd.matrixV().col(i).transpose();
  }
  return projection;
}

}  // namespace

Drive::Drive(const DriveParams& params) : params_(params) {
  Eigen::MatrixX3d sideways(0, 3);
  for (const auto& wheel : params_.wheels) {
    straight_.push_back(rowsAt(wheel, 0.0));
    if (wheel.kind != WheelKind::kFixed) continue;
    has_fixed_ = true;
    fixed_direction_ = straight_.back().rolling.head<2>().transpose();
    sideways.conservativeResize(sideways.rows() + 1, 3);
    sideways.bottomRows<1>() = straight_.back().sideways;
  }
  allowed_ = nullSpaceProjection(sideways);
  checkDetermined();
}

void Drive::checkDetermined() const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const auto& row : straight_) {
    normal += row.rolling.transpose() * row.rolling;
    if (row.has_sideways) normal += row.sideways.transpose() * row.sideways;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  if (solver.eigenvalues()(0) > kRankThreshold * solver.eigenvalues()(2)) return;
  const Eigen::Vector3d free = solver.eigenvectors().col(0);
  throw ParameterError(
      "the " + std::to_string(size()) + " wheels do not determine the motion forward " +
      std::to_string(free.x()) + " m, left " + std::to_string(free.y()) + " m, turning " +
      std::to_string(free.z()) +
      " rad; most likely a wheel is missing, or positions or directions coincide: check wheel_1 to "
      "wheel_N of the section `drive`");
}

WheelRows Drive::rowsAt(const WheelParams& wheel, double steering_rad) const {
  const double direction_rad = kRadPerDeg * wheel.direction_deg + steering_rad;
  if (wheel.kind == WheelKind::kRollers) {
    const double roller_rad = kRadPerDeg * wheel.roller_deg;
    return {along(direction_rad + roller_rad, wheel) / std::cos(roller_rad), Eigen::RowVector3d::Zero(),
            false};
  }
  return {along(direction_rad, wheel), along(direction_rad + 0.5 * kPi, wheel), true};
}

WheelRows Drive::rows(std::size_t wheel, double steering_rad) const {
  return steered(wheel) ? rowsAt(params_.wheels[wheel], steering_rad) : straight_[wheel];
}

Twist Drive::nearestPossible(const Twist& twist) const {
  if (!has_fixed_) return twist;
  const Twist possible = allowed_ * twist;
  Twist straight = Twist::Zero();
  straight.head<2>() = fixed_direction_ * fixed_direction_.dot(possible.head<2>());
  const Twist turning = possible - straight;
  double share = 1.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double limit_deg = params_.wheels[i].max_steering_deg;
    if (!steered(i) || limit_deg >= 90.0) continue;
    // The contact point may move across by at most tan(limit) of what it moves ahead. Both change with the
    // turn.
    const double tangent = std::tan(kRadPerDeg * limit_deg);
    const double ahead = straight_[i].rolling * straight;
    const double turn_ahead = double(straight_[i].rolling * turning) * (ahead < 0.0 ? -1.0 : 1.0);
    const double turn_across = std::abs(double(straight_[i].sideways * turning));
    const double needed = turn_across - tangent * turn_ahead;
    if (needed > tangent * std::abs(ahead)) share = std::min(share, tangent * std::abs(ahead) / needed);
  }
  return straight + share * turning;
}

std::vector<WheelState> Drive::inverse(const Twist& twist) const {
  const Twist possible = nearestPossible(twist);
  std::vector<WheelState> wheels(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const double rolling = straight_[i].rolling * possible;
    if (!steered(i)) {
      wheels[i].speed_m_per_s = rolling;
      continue;
    }
    const double sideways = straight_[i].sideways * possible;
    wheels[i].speed_m_per_s = std::hypot(rolling, sideways);
    if (wheels[i].speed_m_per_s == 0.0) continue;
    wheels[i].steering_rad = std::atan2(sideways, rolling);
    if (std::abs(wheels[i].steering_rad) > kRadPerDeg * params_.wheels[i].max_steering_deg + kRankThreshold) {
      wheels[i].steering_rad = wrapRadians(wheels[i].steering_rad + kPi);
      wheels[i].speed_m_per_s *= -1.0;
    }
  }
  return wheels;
}

ForwardResult Drive::forward(const std::vector<WheelState>& wheels) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int equations = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const WheelRows row = rows(i, wheels[i].steering_rad);
    normal += row.rolling.transpose() * row.rolling;
    right += row.rolling.transpose() * wheels[i].speed_m_per_s;
    ++equations;
    if (!row.has_sideways) continue;
    normal += row.sideways.transpose() * row.sideways;
    ++equations;
  }
  ForwardResult result;
  result.twist = normal.ldlt().solve(right);
  double squares = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const WheelRows row = rows(i, wheels[i].steering_rad);
    const double rolling = wheels[i].speed_m_per_s - row.rolling * result.twist;
    const double sideways = row.has_sideways ? double(row.sideways * result.twist) : 0.0;
    squares += rolling * rolling + sideways * sideways;
  }
  if (equations > 3) result.slip_m_per_s = std::sqrt(squares / (equations - 3));
  return result;
}

}  // namespace stereo_nav::kinematics
