#include "stereo_nav/imu/emulation/motion.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "stereo_nav/imu/attitude_filter.h"

namespace stereo_nav::imu {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d kUpwards(0.0, 0.0, AttitudeFilter::kGravity_m_s2);

Vector3d rotationVector(const Quaterniond& q) {
  const AngleAxisd turn(q);
  return turn.axis() * turn.angle();
}

Vector3d rateOf(const std::function<Quaterniond(double)>& attitude, double time_s) {
  constexpr double kHalf_s = 5e-4;
  const Quaterniond turn = attitude(time_s - kHalf_s).conjugate() * attitude(time_s + kHalf_s);
  return rotationVector(turn) / (2.0 * kHalf_s);
}

/// The two poses around a time and where between them it lies.
struct Bracket {
  const RecordedPose& before;
  const RecordedPose& after;
  double share;
};

Bracket bracket(const std::vector<RecordedPose>& poses, double time_s) {
  const auto after = std::upper_bound(poses.begin() + 1, poses.end() - 1, time_s,
                                      [](double t, const RecordedPose& pose) { return t < pose.time_s; });
  const RecordedPose& first = *(after - 1);
  const double share = (time_s - first.time_s) / (after->time_s - first.time_s);
  return {first, *after, std::clamp(share, 0.0, 1.0)};
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
    const double angle = 2.0 * M_PI * std::fmod(std::max(t, 0.0), kTurn_s) / kTurn_s;
    // Turns about z start from the x axis pointing up, so that every axis meets gravity.
    const Quaterniond start = std::max(axis, 0) == 2 ? Quaterniond(AngleAxisd(-M_PI / 2, Vector3d::UnitY()))
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

Motion recordedMotion(std::vector<RecordedPose> poses) {
  const auto shared = std::make_shared<const std::vector<RecordedPose>>(std::move(poses));
  const double start_s = shared->front().time_s;
  const auto attitude = [shared, start_s](double t) {
    const Bracket at = bracket(*shared, start_s + t);
    return at.before.q_world_imu.slerp(at.share, at.after.q_world_imu);
  };
  const auto position = [shared, start_s](double t) -> Vector3d {
    const Bracket at = bracket(*shared, start_s + t);
    return at.before.position_m + at.share * (at.after.position_m - at.before.position_m);
  };
  const Motion rotation = rotatingMotion(attitude);
  return [=](double t) {
    constexpr double kHalf_s = 0.1;
    MotionState state = rotation(t);
    const Vector3d acceleration =
        (position(t + kHalf_s) - 2.0 * position(t) + position(t - kHalf_s)) / (kHalf_s * kHalf_s);
    state.linear_acceleration += state.q_world_imu.conjugate() * acceleration;
    return state;
  };
}

std::vector<RecordedPose> readPoses(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path + ": does it exist?");
  std::vector<RecordedPose> poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    RecordedPose pose{};
    Vector3d& p = pose.position_m;
    Quaterniond& q = pose.q_world_imu;
    if (!(fields >> pose.time_s >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w()) ||
        !(q.norm() > 0.5) || (!poses.empty() && pose.time_s <= poses.back().time_s)) {
      throw std::runtime_error(path + ", line " + std::to_string(number) +
                               ": expected `time x y z qx qy qz qw` with growing time");
    }
    q.normalize();
    poses.push_back(pose);
  }
  if (poses.size() < 2) throw std::runtime_error(path + ": holds fewer than two poses");
  return poses;
}

}  // namespace stereo_nav::imu
