#include "odometry/laser/measured_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planar_motion.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kHistory_s = 30.0;
/// Wheels count while their driver is silent, too; but in a longer gap the motion of a single scan is not
/// known.
constexpr double kMaxWheelGap_s = 10.0;
/// No wheels go that fast, m/s or rad/s; stamps that jitter only feign it over a short way, m or rad.
constexpr double kLeastJump = 1.5;
constexpr double kFastest = 20.0;
/// A stamp that is older by more is no late message: the clock was set back, or the stamp before was wrong.
constexpr double kSetBack_s = 1.0;
constexpr double kPiece_s = 0.025;
constexpr int kMostPieces = 200;

}  // namespace

void MotionInputs::addWheels(double time_s, const Eigen::Isometry2d& T_wheels_base) {
  if (!std::isfinite(time_s) || !T_wheels_base.matrix().allFinite()) return;
  if (!wheels_.empty() && time_s < wheels_.back().time_s - kSetBack_s) wheels_.clear();
  if (!wheels_.empty() && time_s <= wheels_.back().time_s) return;
  if (!wheels_.empty() && jumps(wheels_.back(), {time_s, T_wheels_base})) wheels_.clear();
  wheels_.push_back({time_s, T_wheels_base});
  while (wheels_.front().time_s < time_s - kHistory_s) wheels_.pop_front();
}

/// Their pose was set, or they were started again.
bool MotionInputs::jumps(const WheelPose& from, const WheelPose& to) {
  const Eigen::Vector3d step = logPlanar(from.T_wheels_base.inverse() * to.T_wheels_base);
  const double way = std::max(step.head<2>().norm(), std::abs(step.z()));
  return way > kLeastJump && way > kFastest * (to.time_s - from.time_s);
}

void MotionInputs::addImu(const ImuSample& sample, const Eigen::Matrix3d& R_base_imu) {
  R_base_imu_ = R_base_imu;
  if (!gyro_.empty() && sample.time_s < gyro_.newest_s() - kSetBack_s) gyro_.clear();
  ImuSample rates = sample;
  if (rates.angular_velocity) rates.q_world_imu.reset();
  gyro_.add(rates);
}

void MotionInputs::forgetNewerThan(double time_s) {
  if (!wheels_.empty() && wheels_.back().time_s > time_s) wheels_.clear();
  if (!gyro_.empty() && gyro_.newest_s() > time_s) gyro_.clear();
}

double MotionInputs::newestWheels_s() const {
  return wheels_.empty() ? -std::numeric_limits<double>::infinity() : wheels_.back().time_s;
}

std::optional<Eigen::Isometry2d> MotionInputs::wheelsAt(double time_s) const {
  const auto after = std::lower_bound(wheels_.begin(), wheels_.end(), time_s,
                                      [](const WheelPose& pose, double t) { return pose.time_s < t; });
  if (after == wheels_.end()) return std::nullopt;
  if (after->time_s == time_s) return after->T_wheels_base;
  if (after == wheels_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap_s = after->time_s - before->time_s;
  if (gap_s > kMaxWheelGap_s) return std::nullopt;
  const double share = (time_s - before->time_s) / gap_s;
  return before->T_wheels_base *
         expPlanar(share * logPlanar(before->T_wheels_base.inverse() * after->T_wheels_base));
}

MeasuredMotion MotionInputs::between(double from_s, double to_s) const {
  MeasuredMotion motion;
  if (!(to_s > from_s)) return motion;
  const int count =
      std::clamp(static_cast<int>(std::ceil((to_s - from_s) / kPiece_s - 1e-6)), 1, kMostPieces);
  const double piece_s = (to_s - from_s) / count;
  bool wheels = true, gyro = !gyro_.empty();
  std::vector<Eigen::Vector3d> by_wheels(static_cast<std::size_t>(count), Eigen::Vector3d::Zero());
  std::vector<double> by_gyro(static_cast<std::size_t>(count), 0.0);
  std::optional<Eigen::Isometry2d> T_wheels_before = wheelsAt(from_s);
  for (int i = 0; i < count && (wheels || gyro); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double start_s = from_s + i * piece_s, end_s = i + 1 == count ? to_s : start_s + piece_s;
    const auto T_wheels_after = wheels ? wheelsAt(end_s) : std::nullopt;
    wheels = wheels && T_wheels_before && T_wheels_after;
    if (wheels) by_wheels[k] = logPlanar(T_wheels_before->inverse() * *T_wheels_after) / piece_s;
    T_wheels_before = T_wheels_after;
    if (!gyro) continue;
    const auto R_now_before = gyro_.increment(start_s, end_s, R_base_imu_);
    gyro = R_now_before.has_value();
    if (!gyro) continue;
    const Eigen::AngleAxisd turn(R_now_before->transpose());
    by_gyro[k] = turn.angle() * turn.axis().z() / piece_s;
  }
  if (wheels) motion.translation = RateSource::kWheels;
  motion.rotation = gyro ? RateSource::kGyro : wheels ? RateSource::kWheels : RateSource::kNone;
  for (std::size_t k = 0; k < by_wheels.size(); ++k) {
    RatePiece piece;
    piece.duration_s = piece_s;
    if (wheels) piece.rate = by_wheels[k];
    piece.rate.z() = gyro ? by_gyro[k] : piece.rate.z();
    motion.pieces.push_back(piece);
  }
  return motion;
}

}  // namespace stereo_nav::odometry
