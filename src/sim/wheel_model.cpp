#include "sim/wheel_model.h"

#include <fmt/format.h>

#include <cmath>

#include "core/planar_motion.h"
#include "kinematics/drive.h"
#include "kinematics/wheel_commander.h"
#include "sim/random.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::sim {
namespace {

constexpr double kImpossible = 0.02;  // m/s, rad/s

/// Throws where the drive cannot move like this.
void requirePossible(const kinematics::Drive& drive, const kinematics::Twist& twist, double time_s) {
  if ((drive.nearestPossible(twist) - twist).norm() < kImpossible) return;
  throw InputError(fmt::format(
      "the drive of the rig file cannot follow the course: at {:.1f} s it would move {:.2f} m/s ahead, {:.2f} m/s to "
      "the left and turn by {:.2f} rad/s; take a drive that can, or a scenario without turns on the spot",
      time_s, twist.x(), twist.y(), twist.z()));
}

/// The wheels of a base that is moved.
class RollingWheels {
 public:
  RollingWheels(const kinematics::DriveParams& params, double slip_sigma_m, std::uint64_t key)
      : drive_(params),
        slip_sigma_m_(slip_sigma_m),
        random_(key),
        rolled_m_(drive_.size(), 0.0),
        steering_rad_(drive_.size(), 0.0) {
    for (std::size_t i = 0; i < drive_.size(); ++i) steered_ = steered_ || drive_.steered(i);
  }

  void move(const kinematics::Twist& twist, double duration_s, double time_s) {
    requirePossible(drive_, twist, time_s);
    const auto wheels = drive_.inverse(twist);
    for (std::size_t i = 0; i < drive_.size(); ++i) {
      kinematics::WheelState wheel = wheels[i];
      if (drive_.steered(i) && wheel.speed_m_per_s != 0.0) {
        if (drive_.params().wheels[i].max_steering_deg >= 180.0)
          wheel = kinematics::leastSteering(wheel, steering_rad_[i]);
        steering_rad_[i] = wheel.steering_rad;
      }
      const double way_m = wheel.speed_m_per_s * duration_s;
      rolled_m_[i] += way_m + slip_sigma_m_ * std::sqrt(std::abs(way_m)) * random_.normal();
    }
  }

  SimulatedTicks read(double time_s) const {
    SimulatedTicks ticks{time_s, {}, {}};
    for (std::size_t i = 0; i < drive_.size(); ++i)
      ticks.pulses.push_back(std::llround(rolled_m_[i] / drive_.params().wheels[i].metresPerPulse()));
    if (steered_) ticks.steering_rad = steering_rad_;
    return ticks;
  }

 private:
  kinematics::Drive drive_;
  double slip_sigma_m_;
  RandomStream random_;
  std::vector<double> rolled_m_;
  std::vector<double> steering_rad_;
  bool steered_ = false;
};

}  // namespace

kinematics::DriveParams trueDrive(const WheelModelParams& params, const kinematics::DriveParams& nominal,
                                  std::uint64_t seed) {
  RandomStream random(streamKey(seed, Stream::kWheelGeometry));
  kinematics::DriveParams drive = nominal;
  for (auto& wheel : drive.wheels) {
    wheel.radius_m *= 1.0 + params.radius_sigma * random.normal();
    const double x_m = params.position_sigma_m * random.normal();
    wheel.y_m += params.position_sigma_m * random.normal();
    if (wheel.kind == kinematics::WheelKind::kRollers) wheel.x_m += x_m;
  }
  return drive;
}

std::vector<SimulatedTicks> simulateWheels(const WheelModelParams& params,
                                           const kinematics::DriveParams& true_drive,
                                           const Trajectory& trajectory, std::uint64_t seed) {
  RollingWheels wheels(true_drive, params.slip_sigma_m, streamKey(seed, Stream::kWheelSlip));
  const double period_s = 1.0 / params.rate_hz;
  const auto count = static_cast<std::size_t>(std::floor(trajectory.duration_s() * params.rate_hz)) + 1;
  std::vector<SimulatedTicks> ticks;
  Eigen::Isometry2d before = planarPart(trajectory.pose(0.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(i) * period_s;
    const Eigen::Isometry2d now = planarPart(trajectory.pose(time_s));
    if (i > 0) wheels.move(logPlanar(before.inverse() * now) / period_s, period_s, time_s);
    before = now;
    ticks.push_back(wheels.read(time_s + 1e-3 * params.latency_ms));
  }
  return ticks;
}

void WheelModelParams::describe(ParameterVisitor& visitor) {
  visitor.real("rate_hz", rate_hz, {1.0, 1000.0}, "Hz", "readings of the counters per second");
  visitor.real("latency_ms", latency_ms, {0.0, 200.0}, "ms", "stamps are this late");
  visitor.real("slip_sigma_m", slip_sigma_m, {0.0, 1.0}, "m",
               "standard deviation of what a wheel slips on 1 m; grows with the root of the way");
  visitor.real("radius_sigma", radius_sigma, {0.0, 0.5}, "",
               "standard deviation of the true radii about those of the rig file, relative");
  visitor.real("position_sigma_m", position_sigma_m, {0.0, 0.5}, "m",
               "standard deviation of the true contact points about those of the rig file");
}

}  // namespace stereo_nav::sim
