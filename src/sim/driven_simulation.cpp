#include "sim/driven_simulation.h"

#include <algorithm>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::sim {
namespace {

constexpr double kStep_s = 1e-3;
/// Rounding of times that are sums of steps.
constexpr double kTiny_s = 1e-7;
/// m/s and rad/s: slower than this, people take the robot to be standing.
constexpr double kStands = 0.01;

Eigen::Isometry2d startOf(const DrivenParams& params) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.translation() = Eigen::Vector2d(params.start_x_m, params.start_y_m);
  T.linear() = Eigen::Rotation2Dd(params.start_yaw_deg * kRadPerDeg).toRotationMatrix();
  return T;
}

}  // namespace

cv::Mat StereoShot::image(Side side, const StereoCameras& cameras) const {
  return cameras.image(
      side, scene, [this](double t) { return motion.pose(t); }, time_s(side), exposure(side), index);
}

DrivenSimulation::DrivenSimulation(const Scenario& scenario, const DrivenRig& rig,
                                   const StereoCalibrationPair& calibration, std::uint64_t seed)
    : scenario_(scenario),
      rig_(rig),
      scene_(scenario.scene),
      motion_(startOf(scenario.driven), kStep_s),
      start_(motion_.pose(0.0)),
      base_(scenario.driven, scenario.wheels, rig, seed),
      body_(scenario.driven),
      imu_(scenario.imu, seed),
      range_noise_(streamKey(seed, Stream::kRange)),
      pairs_(pairInstants(scenario.timing, scenario.driven.longest_s, seed)),
      cameras_(std::make_shared<StereoCameras>(scenario, calibration, seed)) {
  for (const LaserRig& laser : rig_.lasers) lasers_.emplace_back(scenario_.laser, laser, seed);
  const SensorParams& sensor = scenario_.sensor;
  if (!sensor.auto_exposure.on) return;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    auto& loop = auto_exposure_[static_cast<std::size_t>(side)];
    loop.emplace(sensor.auto_exposure, sensor.exposure_ms, sensor.processing.gamma);
    for (int before = 0; before < kImagesBefore; ++before) expose(side, 0.0);
  }
}

void DrivenSimulation::advance(double time_s, DrivenSink& sink) {
  if (next_ticks_ == 0) deliver(sink);
  while (motion_.time_s() + kStep_s <= time_s + kTiny_s) {
    moveBase();
    reportContacts(sink);
    deliver(sink);
  }
}

void DrivenSimulation::deliver(DrivenSink& sink) {
  deliverTicks(sink);
  deliverImu(sink);
  deliverRanges(sink);
  for (LaserModel& laser : lasers_) {
    const auto base = [this](double t) { return motion_.pose(t); };
    if (const auto scan = laser.advance(scene_, base, time_s())) sink.takeScan(*scan);
  }
  deliverShot(sink);
}

void DrivenSimulation::moveBase() {
  const kinematics::Twist twist = base_.step(kStep_s);
  const Eigen::Isometry2d& before = motion_.T_world_base();
  if (twist.norm() < kStands) body_.holdWalkers(scene_, before, motion_.time_s(), kStep_s);
  const Eigen::Isometry2d after = before * expPlanar(twist * kStep_s);
  const bool is_free = body_.tryMotion(scene_, before, after, motion_.time_s() + kStep_s);
  motion_.add(is_free ? twist : kinematics::Twist::Zero());
}

void DrivenSimulation::reportContacts(DrivenSink& sink) {
  if (body_.touched() == touched_) return;
  touched_ = body_.touched();
  std::vector<std::string> names;
  for (const std::size_t solid : touched_) names.push_back(scene_.solids()[solid].name);
  sink.takeContacts(time_s(), names);
}

void DrivenSimulation::deliverTicks(DrivenSink& sink) {
  if (static_cast<double>(next_ticks_) / scenario_.wheels.rate_hz > time_s() + kTiny_s) return;
  ++next_ticks_;
  SimulatedTicks ticks = base_.ticks();
  ticks.time_s = time_s();
  sink.takeTicks(ticks, state());
}

void DrivenSimulation::deliverImu(DrivenSink& sink) {
  if (scenario_.imu.kind == ImuKind::kNone) return;
  for (;; ++next_imu_) {
    const double true_s = static_cast<double>(next_imu_) / scenario_.imu.rate_hz;
    if (true_s + imu_.latency_s() > time_s() + kTiny_s) return;
    sink.takeImu(imu_.sample(motion_.state(true_s), true_s));
  }
}

void DrivenSimulation::deliverRanges(DrivenSink& sink) {
  if (static_cast<double>(next_range_) / scenario_.range.rate_hz > time_s() + kTiny_s) return;
  ++next_range_;
  for (std::size_t i = 0; i < rig_.ranges.size(); ++i) {
    sink.takeRange(i, time_s(),
                   measureRange(scenario_.range, rig_.ranges[i], scene_, motion_.pose(time_s()), time_s(),
                                range_noise_));
  }
}

void DrivenSimulation::deliverShot(DrivenSink& sink) {
  if (next_pair_ >= pairs_.size()) return;
  const PairInstants& pair = pairs_[next_pair_];
  const double open_s = 1e-3 * (scenario_.sensor.exposure_ms + scenario_.sensor.rolling_shutter_ms);
  if (std::max(pair.left_s, pair.right_s) + 0.5 * open_s > time_s() + kTiny_s) return;
  sink.takeShot({pair, next_pair_++, expose(Side::kLeft, pair.left_s), expose(Side::kRight, pair.right_s),
                 scene_, motion_});
}

/// With what an image is taken; the automatic exposure sees it.
ExposureSetting DrivenSimulation::expose(Side side, double time_s) {
  auto& loop = auto_exposure_[static_cast<std::size_t>(side)];
  if (!loop) return {scenario_.sensor.exposure_ms, 1.0};
  const ExposureSetting setting = loop->setting();
  loop->see(cameras_->metered(
      side, scene_, [this](double t) { return motion_.pose(t); }, time_s, setting));
  return setting;
}

}  // namespace stereo_nav::sim
