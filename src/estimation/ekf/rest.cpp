#include "estimation/ekf/rest.h"

#include <algorithm>
#include <cmath>

#include "estimation/ekf/odometry_motion.h"

namespace stereo_nav::estimation {
namespace {

using Kind = Measurement::Kind;
constexpr double kSmoothing_s = 0.3;
constexpr double kHeard_s = 0.5;
constexpr double kRestSpeed_m_s = 0.005;
constexpr double kRestTurn_rad_s = 0.005;
constexpr double kVelocitySigma_m_s = 0.002;
constexpr double kTurnSigma_rad_s = 0.001;

}  // namespace

bool tellsTwist(Kind kind) {
  return kind == Kind::kTwist || kind == Kind::kRate || kind == Kind::kMotion;
}

Vector6d twistOf(const Measurement& measurement, const State& state, const ChannelMemory& memory) {
  Vector6d twist = Vector6d::Zero();
  if (measurement.kind == Kind::kRate) twist.tail<3>() = measurement.value.tail<3>() - state.gyro_bias;
  if (measurement.kind == Kind::kTwist) twist = measurement.value;
  if (measurement.kind == Kind::kMotion && memory.anchored && measurement.time_s > memory.anchored_s)
    twist = logMotion(memory.T_odometry_base.inverse() * measurement.pose) /
            (measurement.time_s - memory.anchored_s);
  for (int field = 0; field < 6; ++field) {
    if (std::find(measurement.fields.begin(), measurement.fields.end(), field) == measurement.fields.end())
      twist[field] = 0.0;
  }
  return twist;
}

bool tellsWay(const Measurement& measurement, const ChannelMemory& memory) {
  if (measurement.kind != Kind::kTwist && measurement.kind != Kind::kMotion) return false;
  Matrix6d covariance = measurement.covariance;
  if (measurement.kind == Kind::kMotion) {
    if (!memory.anchored || measurement.time_s <= memory.anchored_s) return false;
    const OdometryMotion motion = motionSince(memory, measurement);
    covariance = motion.covariance / (motion.duration_s * motion.duration_s);
  }
  for (const int field : measurement.fields) {
    if (field < 3 && covariance(field, field) > kToldSigma_m_s * kToldSigma_m_s) return false;
  }
  return true;
}

void smoothTwist(const Vector6d& twist, double interval_s, ChannelMemory& memory) {
  const double share = 1.0 - std::exp(-std::min(interval_s, kHeard_s) / kSmoothing_s);
  memory.smooth_twist += share * (twist - memory.smooth_twist);
}

bool sayRest(const std::vector<Channel>& channels, const std::vector<ChannelMemory>& memories,
             double time_s) {
  bool way_measured = false;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!tellsTwist(channels[i].kind) || time_s - memories[i].newest_s > kHeard_s) continue;
    if (memories[i].smooth_twist.head<3>().norm() > kRestSpeed_m_s) return false;
    if (memories[i].smooth_twist.tail<3>().norm() > kRestTurn_rad_s) return false;
    way_measured = way_measured || memories[i].tells_way;
  }
  return way_measured;
}

Innovation observeRest(const StateLayout& layout, const State& state) {
  std::vector<int> kept;
  for (int row = error_row::kVelocity; row < error_row::kVelocity + 6; ++row) {
    if (layout.at(row) >= 0) kept.push_back(row);
  }
  Vector6d twist;
  twist << state.velocity, state.rate;
  const auto n = static_cast<Eigen::Index>(kept.size());
  Innovation innovation;
  innovation.residual.resize(n);
  innovation.H.setZero(n, layout.rows());
  innovation.noise.setZero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int field = kept[static_cast<std::size_t>(i)] - error_row::kVelocity;
    innovation.residual[i] = -twist[field];
    innovation.H(i, layout.at(error_row::kVelocity + field)) = 1.0;
    innovation.noise(i, i) = std::pow(field < 3 ? kVelocitySigma_m_s : kTurnSigma_rad_s, 2);
    innovation.fields.push_back(field);
  }
  for (int i = 0; i < kWheelScales; ++i) {
    if (layout.at(error_row::kScale + i) >= 0) innovation.unmoved.push_back(layout.at(error_row::kScale + i));
  }
  return innovation;
}

}  // namespace stereo_nav::estimation
