#include "odometry/method/imu_contradiction.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kWindow_s = 5.0;
constexpr double kLongestGap_s = 1.0;  ///< between two frames whose turn still tells something
constexpr double kLeastTurn_rad = 0.25;
constexpr int kFewestFrames = 10;
// Where no usual mistake explains it, the images may be wrong as well: more of them have to say so.
constexpr int kFewestUnexplained = 30;
constexpr double kLeastUnexplained_rad = 0.5;
constexpr double kContradiction =
    0.4;                            ///< share of the turns; what noise, bias and jitter cause stays below 0.2
constexpr double kExplained = 0.2;  ///< share that an explanation may leave over
constexpr double kLargestBias_rad_s = 0.15;  ///< of the rates of a cheap gyroscope
constexpr double kStill_rad = 1e-6;          ///< of a frame: an IMU that works has noise, even at rest
constexpr double kLeastRate_rad_s = 0.1;     ///< slower turns tell little more than noise
constexpr double kLeastDegrees = 20.0;       ///< rates in deg/s are 57 times too large, give or take a bias
constexpr double kLongestDelay_s = 1.0;
constexpr double kDelayStep_s = 0.005;

}  // namespace

double ImuContradiction::Comparison::share() const {
  return difference_rad / std::max({seen_rad, sensed_rad, 1e-9});
}

bool ImuContradiction::Comparison::contradicts() const {
  return frames >= kFewestFrames && std::max(seen_rad, sensed_rad) >= kLeastTurn_rad &&
         share() > kContradiction;
}

void ImuContradiction::add(double previous_s, double current_s, const Eigen::Matrix3d& R_current_previous) {
  if (!turns_.empty() && previous_s < turns_.back().previous_s) turns_.clear();
  if (current_s - previous_s > kLongestGap_s) return;
  turns_.push_back({previous_s, current_s, -logRotation(R_current_previous), std::nullopt});
  while (turns_.front().previous_s < current_s - kWindow_s) turns_.pop_front();
}

void ImuContradiction::lookUp(const RotationHistory& imu) {
  for (auto turn = turns_.rbegin(); turn != turns_.rend() && !turn->sensed; ++turn) {
    turn->sensed = sensed(imu, *turn, 0.0);
  }
}

std::optional<Eigen::Vector3d> ImuContradiction::sensed(const RotationHistory& imu, const Turn& turn,
                                                        double delay_s) const {
  const double from_s = turn.previous_s + delay_s;
  const double to_s = turn.current_s + delay_s;
  const Eigen::Matrix3d R_camera_imu = axes_.R_camera_imu();
  if (imu.attitude(from_s)) {
    const auto R_current_previous = imu.increment(from_s, to_s, R_camera_imu);
    if (!R_current_previous) return std::nullopt;
    return Eigen::Vector3d(-logRotation(*R_current_previous));
  }
  // Not integrated as rotations: of rates in deg/s nothing but their direction would be left.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  constexpr int kParts = 4;
  for (int part = 0; part <= kParts; ++part) {
    const auto rate = imu.angularVelocity(from_s + (to_s - from_s) * part / kParts);
    if (!rate) return std::nullopt;
    sum += (part == 0 || part == kParts ? 0.5 : 1.0) / kParts * *rate;
  }
  return Eigen::Vector3d(R_camera_imu * sum * (to_s - from_s));
}

ImuContradiction::Comparison ImuContradiction::compare(const RotationHistory& imu, double factor,
                                                       double delay_s, const Eigen::Matrix3d& R) const {
  struct Pair {
    Eigen::Vector3d seen, sensed;
    double interval_s;
  };
  std::vector<Pair> pairs;
  Eigen::Vector3d excess = Eigen::Vector3d::Zero();
  double time_s = 0.0;
  for (const Turn& turn : turns_) {
    const auto turned = delay_s == 0.0 ? turn.sensed : sensed(imu, turn, delay_s);
    if (!turned) continue;
    pairs.push_back({turn.seen, factor * (R * *turned), turn.current_s - turn.previous_s});
    excess += pairs.back().sensed - turn.seen;
    time_s += pairs.back().interval_s;
  }
  // A constant bias of the rates is no contradiction; attitudes have none.
  const bool has_attitude = !turns_.empty() && imu.attitude(turns_.back().current_s + delay_s);
  const double most_rad_s = has_attitude ? 0.0 : kLargestBias_rad_s;
  const Eigen::Vector3d bias = (excess / std::max(time_s, 1e-9)).cwiseMin(most_rad_s).cwiseMax(-most_rad_s);
  Comparison comparison;
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d sensed_rad = pair.sensed - bias * pair.interval_s;
    if (std::max(pair.seen.norm(), sensed_rad.norm()) < kLeastRate_rad_s * pair.interval_s) continue;
    comparison.seen_rad += pair.seen.norm();
    comparison.sensed_rad += sensed_rad.norm();
    comparison.difference_rad += (pair.seen - sensed_rad).norm();
    if (pair.sensed.norm() < kStill_rad) comparison.unsensed_rad += pair.seen.norm();
    ++comparison.frames;
  }
  return comparison;
}

bool ImuContradiction::isSuspected(const RotationHistory& imu) {
  lookUp(imu);
  return compare(imu, 1.0, 0.0, Eigen::Matrix3d::Identity()).contradicts();
}

std::optional<std::string> ImuContradiction::find(const RotationHistory& imu) {
  lookUp(imu);
  const Eigen::Matrix3d unturned = Eigen::Matrix3d::Identity();
  const Comparison now = compare(imu, 1.0, 0.0, unturned);
  if (!now.contradicts() || now.seen_rad < kLeastTurn_rad) return std::nullopt;
  const std::string seen =
      fmt::format("the images show turns of {:.0f} deg in {} frames, the IMU senses {:.0f} deg",
                  now.seen_rad * kDegPerRad, now.frames, now.sensed_rad * kDegPerRad);
  if (now.sensed_rad > kLeastDegrees * now.seen_rad &&
      compare(imu, 1.0 / kDegPerRad, 0.0, unturned).share() < kExplained)
    return seen + ": its rates are in deg/s; have the driver publish rad/s";
  if (compare(imu, -1.0, 0.0, unturned).share() < kExplained)
    return seen +
           " the other way round: the signs of its axes are reversed against tf; correct the driver or `mounting` "
           "of the rig file";
  // Not all of it: an IMU that stops may jump first.
  if (now.unsensed_rad > 0.8 * now.seen_rad)
    return seen +
           ": its orientation or its rates stay the same while it turns; is the module's own filter running?";
  if (const auto delay = explainedByDelay(imu)) return seen + ": " + *delay;
  if (const auto axes = explainedByAxes(imu)) return seen + ", about other axes: " + *axes;
  if (now.frames < kFewestUnexplained || now.seen_rad < kLeastUnexplained_rad) return std::nullopt;
  return seen +
         fmt::format(
             ", which differ by {:.0f} % of these: is it fixed to the rig, and are its unit and scale right?",
             100.0 * now.share());
}

std::optional<std::string> ImuContradiction::explainedByDelay(const RotationHistory& imu) const {
  const Comparison now = compare(imu, 1.0, 0.0, Eigen::Matrix3d::Identity());
  double best_s = 0.0;
  double best_share = kExplained;
  for (double delay_s = -kLongestDelay_s; delay_s <= kLongestDelay_s; delay_s += kDelayStep_s) {
    const Comparison later = compare(imu, 1.0, delay_s, Eigen::Matrix3d::Identity());
    if (2 * later.frames < now.frames || !(later.seen_rad >= kLeastTurn_rad)) continue;
    if (later.share() >= best_share) continue;
    best_share = later.share();
    best_s = delay_s;
  }
  if (best_s == 0.0) return std::nullopt;
  return fmt::format(
      "its stamps are {:.3f} s too {}; correct them where the IMU is read (imu_bridge: latency_s)",
      std::abs(best_s), best_s > 0.0 ? "late" : "early");
}

/// Kabsch's rotation of the sensed turns onto those seen. Turns about one axis leave it open by a rotation
/// about that axis: then only the mistake is named.
std::optional<std::string> ImuContradiction::explainedByAxes(const RotationHistory& imu) const {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const Turn& turn : turns_) {
    if (turn.sensed) moment += turn.seen * turn.sensed->transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d R = svd.matrixU() * sign * svd.matrixV().transpose();
  if (compare(imu, 1.0, 0.0, R).share() > kExplained) return std::nullopt;
  constexpr double kSecondAxis = 0.05;  // of the squares of the turns
  if (svd.singularValues()[1] < kSecondAxis * svd.singularValues()[0]) {
    return std::string(
        "an axis or its sign is not that of tf; turn the rig about a second axis, too, or run calibrate_imu_rotation, and "
        "write the IMU's rotation into `mounting` of the rig file");
  }
  const RollPitchYaw angles = RollPitchYaw::of(axes_.R_base_camera * R * axes_.R_camera_imu());
  return fmt::format(
      "its axes are not those of tf. In `mounting` of the rig file, `imu` needs roll_deg: {:.0f}, pitch_deg: {:.0f}, "
      "yaw_deg: {:.0f}",
      angles.roll * kDegPerRad, angles.pitch * kDegPerRad, angles.yaw * kDegPerRad);
}

}  // namespace stereo_nav::odometry
