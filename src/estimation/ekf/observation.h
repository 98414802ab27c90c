#pragma once

#include <Eigen/Geometry>

#include "estimation/ekf/correction.h"
#include "estimation/ekf/measurement.h"
#include "estimation/ekf/state.h"

namespace stereo_nav::estimation {

/// The measurement of a pose, twist, rate or acceleration against the state, of the fields that the layout
/// keeps; no rows where none of them is. `wheels`: the twist is that of wheels, z = (I + A)^-1 v.
Innovation observe(const StateLayout& layout, const State& state, const Measurement& measurement, bool wheels,
                   double gravity_m_s2);

/// The present pose against an anchor, which an odometry says to be the same: residual = -(T_anchor^-1
/// T_base).
Innovation observeAnchor(const StateLayout& layout, const State& state, int anchor,
                         const std::vector<int>& fields, const Vector6d& variances);

/// Moves an anchor along a motion of the odometry, whose covariance has the axes of base_link at its end.
/// With `wheels` the motion is that of wheels, which the scales correct.
void moveAnchor(const StateLayout& layout, int anchor, const Eigen::Isometry3d& motion,
                const Matrix6d& covariance, bool wheels, State& state);

/// A motion of wheels as their scales correct it.
Eigen::Isometry3d scaled(const Eigen::Isometry3d& motion, const WheelScales& wheel_scale);

}  // namespace stereo_nav::estimation
