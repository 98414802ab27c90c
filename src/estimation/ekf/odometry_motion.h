#pragma once

#include "estimation/ekf/channel.h"

namespace stereo_nav::estimation {

/// The motion of an odometry since its last message.
struct OdometryMotion {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< T_then_now
  Matrix6d covariance = Matrix6d::Zero();                    ///< axes of base_link now
  double duration_s = 0.0;
};

/// An odometry whose speed is less certain than this does not tell it, as a laser in a corridor.
constexpr double kToldSigma_m_s = 0.2;

/// Its covariance is, in this order, what the covariance of the pose has grown by; where that stays the same,
/// which no odometry's does, that of the twist over the time; without either a twentieth of the motion, 2 mm
/// and 1 mrad. Along directions of which the twist says that they are not told it is larger, as errors last.
OdometryMotion motionSince(const ChannelMemory& memory, const Measurement& measurement);

}  // namespace stereo_nav::estimation
