#include "sensors/imu/emulation/motion.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/sensors/imu/attitude_filter.h"

namespace stereo_nav::imu {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d kUpwards(0.0, 0.0, AttitudeFilter::kGravity_m_s2);

Vector3d rateOf(const std::function<Quaterniond(double)>& attitude, double time_s) {
  constexpr double kHalf_s = 5e-4;
  const Quaterniond turn = attitude(time_s - kHalf_s).conjugate() * attitude(time_s + kHalf_s);
  return logRotation(turn) / (2.0 * kHalf_s);
}

/// The pose at a time, interpolated between the two recorded ones around it.
struct Interpolated {
  Vector3d position_m;
  Quaterniond q_world_imu;
};

Interpolated poseAt(const Trajectory& trajectory, double time_s) {
  const auto after = std::upper_bound(trajectory.begin() + 1, trajectory.end() - 1, time_s,
                                      [](double t, const StampedPose& pose) { return t < pose.time_s; });
  const auto before = after - 1;
  const double share = std::clamp((time_s - before->time_s) / (after->time_s - before->time_s), 0.0, 1.0);
  const Eigen::Isometry3d& T_before = before->T_world_body;
  const Eigen::Isometry3d& T_after = after->T_world_body;
  return {T_before.translation() + share * (T_after.translation() - T_before.translation()),
          Quaterniond(T_before.rotation()).slerp(share, Quaterniond(T_after.rotation()))};
}

}  // namespace

Motion rotatingMotion(std::function<Quaterniond(double)> attitude) {
  return [attitude = std::move(attitude)](double time_s) {
    MotionState state;
    state.q_world_imu = attitude(time_s);
    state.angular_velocity = rateOf(attitude, time_s);
    state.linear_acceleration = state.q_world_imu.conjugate() * kUpwards;
    return state;
  };
}

Motion constantRates(const ModuleAngles& start, const ModuleAngles& rates_deg_s) {
  return rotatingMotion([=](double t) {
    return orientationFromModule({start.yaw_deg + rates_deg_s.yaw_deg * t,
                                  start.pitch_deg + rates_deg_s.pitch_deg * t,
                                  start.roll_deg + rates_deg_s.roll_deg * t});
  });
}

Motion slowTurns() {
  constexpr double kTurn_s = 12.0;
  return rotatingMotion([](double t) {
    const int axis = static_cast<int>(std::floor(t / kTurn_s)) % 3;
    const double angle = 2.0 * kPi * std::fmod(std::max(t, 0.0), kTurn_s) / kTurn_s;
    // Turns about z start with the x axis pointing up, so that every axis feels gravity.
    const Quaterniond start = std::max(axis, 0) == 2 ? Quaterniond(AngleAxisd(-kPi / 2, Vector3d::UnitY()))
                                                     : Quaterniond::Identity();
    return Quaterniond(start * AngleAxisd(angle, Vector3d::Unit(std::max(axis, 0))));
  });
}

Motion swaying() {
  return rotatingMotion([](double t) {
    return orientationFromModule(
        {170.0 * std::sin(0.35 * t), 8.0 * std::sin(1.1 * t), 5.0 * std::sin(1.7 * t + 0.5)});
  });
}

Motion headerInsideFloats() {
  // 0x42737469, 0x41737469 and 0x40737469, of which the low three bytes spell "its" in the order of sending.
  return constantRates({60.8636817932, 15.2159204483, 3.8039801121}, {});
}

Motion recordedMotion(Trajectory trajectory) {
  const auto shared = std::make_shared<const Trajectory>(std::move(trajectory));
  const double start_s = shared->front().time_s;
  const Motion rotation = rotatingMotion([=](double t) { return poseAt(*shared, start_s + t).q_world_imu; });
  return [=](double t) {
    constexpr double kHalf_s = 0.1;
    const auto position = [&](double at_s) { return poseAt(*shared, start_s + at_s).position_m; };
    MotionState state = rotation(t);
    const Vector3d acceleration =
        (position(t + kHalf_s) - 2.0 * position(t) + position(t - kHalf_s)) / (kHalf_s * kHalf_s);
    state.linear_acceleration += state.q_world_imu.conjugate() * acceleration;
    return state;
  };
}

}  // namespace stereo_nav::imu
