#include "estimation/range_correction/range_corrector.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kCertain = 0.95;
constexpr double kPossibleSquared = 6.63;  ///< 99 % of the squares of a normal number
constexpr double kNearest_m = 0.1;
constexpr double kMostForeign = 0.5;
constexpr double kLearningShare = 0.1;  ///< about the last ten measurements count
/// Standard deviation of where within its width light answers, as a share of what that changes the range by.
constexpr double kAcrossShare = 0.5;

/// A vector turned by 90 degrees: what it changes by with the yaw.
Eigen::Vector2d turned(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

/// What the error of a pose, x y yaw, becomes by a way: a wrong heading moves it aside.
Eigen::Matrix3d carryOf(const Eigen::Vector2d& way) {
  Eigen::Matrix3d carry = Eigen::Matrix3d::Identity();
  carry.block<2, 1>(0, 2) = turned(way);
  return carry;
}

/// 99.9 % of the sums of so many squares of normal numbers (Wilson and Hilferty 1931).
double largestSum(int count) {
  const double variance = 2.0 / (9.0 * count);
  return count * std::pow(1.0 - variance + 3.09 * std::sqrt(variance), 3);
}

}  // namespace

RangeCorrector::RangeCorrector(const RangeParams& params, std::size_t sensors)
    : params_(params),
      finders_(sensors),
      bias_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sensors))),
      P_(Eigen::MatrixXd::Identity(3 + bias_.size(), 3 + bias_.size()) * std::pow(params.bias_sigma_m, 2)) {
  for (Finder& finder : finders_) finder.foreign_share = params_.foreign_share;
}

void RangeCorrector::setPose(const Eigen::Isometry2d& T_map_base, const Eigen::Matrix3d& covariance) {
  T_map_base_ = T_map_base;
  P_.topRows<3>().setZero();
  P_.leftCols<3>().setZero();
  P_.topLeftCorner<3, 3>() = covariance;
  for (Finder& finder : finders_) {
    finder.readings.clear();
    finder.measured = false;
  }
}

RangeOutcome RangeCorrector::add(const RangeReading& reading, const Eigen::Isometry2d& T_odom_base,
                                 const std::optional<Eigen::Matrix3d>& odom_covariance) {
  moveTo(reading.time_s, T_odom_base, odom_covariance);
  Finder& finder = finders_[reading.sensor];
  finder.readings.push_back({reading, T_odom_base});
  while (finder.readings.size() > static_cast<std::size_t>(params_.readings) ||
         reading.time_s - finder.readings.front().reading.time_s > params_.window_s)
    finder.readings.pop_front();
  RangeOutcome outcome = RangeOutcome::kWaiting;
  if (finder.readings.size() == static_cast<std::size_t>(params_.readings) && movedOn(finder)) {
    outcome = measure(reading.sensor);
    finder.readings.clear();
    if (outcome == RangeOutcome::kUsed) {
      finder.measured = true;
      finder.T_odom_base = T_odom_base;
    }
  }
  ++counts_[static_cast<std::size_t>(outcome)];
  return outcome;
}

void RangeCorrector::moveTo(double time_s, const Eigen::Isometry2d& T_odom_base,
                            const std::optional<Eigen::Matrix3d>& odom_covariance) {
  if (moving_) {
    const Eigen::Isometry2d motion = T_odom_base_.inverse() * T_odom_base;
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(P_.rows(), P_.cols());
    F.topLeftCorner<3, 3>() = carryOf(T_map_base_.linear() * motion.translation());
    P_ = (F * P_ * F.transpose()).eval();
    P_.topLeftCorner<3, 3>() += motionNoise(motion, odom_covariance);
    T_map_base_ = T_map_base_ * motion;
    const double walked = std::pow(params_.bias_walk_m, 2) * std::abs(time_s - time_s_);
    P_.diagonal().tail(bias_.size()).array() += walked;
  }
  moving_ = true;
  time_s_ = time_s;
  T_odom_base_ = T_odom_base;
  odom_covariance_ = odom_covariance;
}

/// By the parameters, and along the directions in which the odometry's covariance grows by more, by that.
Eigen::Matrix3d RangeCorrector::motionNoise(const Eigen::Isometry2d& motion,
                                            const std::optional<Eigen::Matrix3d>& odom_covariance) const {
  const double way_m = motion.translation().norm(), turn_rad = std::abs(yawOf(motion));
  const double way_variance = std::pow(params_.way_noise_m, 2) * way_m;
  Eigen::Matrix3d noise =
      Eigen::Vector3d(way_variance, way_variance, std::pow(params_.turn_noise_rad, 2) * (way_m + turn_rad))
          .asDiagonal();
  if (!odom_covariance || !odom_covariance_) return noise;
  const Eigen::Matrix3d carry = carryOf(T_odom_base_.linear() * motion.translation());
  const Eigen::Matrix3d growth =
      inAxesOf(T_map_odom(), *odom_covariance - carry * *odom_covariance_ * carry.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> more(growth - noise);
  noise +=
      more.eigenvectors() * more.eigenvalues().cwiseMax(0.0).asDiagonal() * more.eigenvectors().transpose();
  return noise;
}

bool RangeCorrector::movedOn(const Finder& finder) const {
  if (!finder.measured) return true;
  const Eigen::Isometry2d motion = finder.T_odom_base.inverse() * T_odom_base_;
  return motion.translation().norm() >= params_.min_way_m || std::abs(yawOf(motion)) >= params_.min_turn_rad;
}

Beam RangeCorrector::beamOf(const Past& past) const {
  const Eigen::Isometry2d T_map_sensor = T_map_odom() * past.T_odom_base * past.reading.T_base_sensor;
  return {T_map_sensor.translation(), yawOf(T_map_sensor), past.reading.half_width_rad, past.reading.nearest};
}

RangeOutcome RangeCorrector::measure(std::size_t sensor) {
  Finder& finder = finders_[sensor];
  const Past& newest = finder.readings.back();
  const double range_m = newest.reading.max_range_m;
  const std::vector<SeenWall> walls = wallsOf(map_, beamOf(newest), std::sqrt(P_(2, 2)), 1.5 * range_m);
  if (walls.empty()) return RangeOutcome::kForeign;
  const double share = (1.0 - finder.foreign_share) / static_cast<double>(walls.size());
  double walls_sum = 0.0, largest = 0.0, farthest_m = 0.0;
  Candidate best;
  for (const SeenWall& wall : walls) {
    const Candidate candidate = candidateOf(wall, sensor);
    const double weight = share * candidate.likelihood;
    walls_sum += weight;
    farthest_m = std::max(farthest_m, candidate.range_m);
    if (weight <= largest) continue;
    largest = weight;
    best = candidate;
  }
  // What the map does not have stands before its walls, at any distance; rarely a wall is gone.
  const bool nearer = newest.reading.range_m < farthest_m;
  const double foreign =
      finder.foreign_share / (nearer ? std::max(kNearest_m, std::min(farthest_m, range_m)) : range_m);
  const double sum = foreign + walls_sum;
  finder.foreign_share += kLearningShare * (foreign / sum - finder.foreign_share);
  finder.foreign_share =
      std::clamp(finder.foreign_share, params_.foreign_share, std::max(kMostForeign, params_.foreign_share));
  if (foreign > largest) return RangeOutcome::kForeign;
  const double nis = best.residual_m * best.residual_m / best.variance;
  if (largest < kCertain * sum || nis > kPossibleSquared) return RangeOutcome::kAmbiguous;
  correct(best);
  return RangeOutcome::kUsed;
}

RangeCorrector::Candidate RangeCorrector::candidateOf(const SeenWall& wall, std::size_t sensor) const {
  const std::deque<Past>& readings = finders_[sensor].readings;
  const auto row = static_cast<Eigen::Index>(sensor);
  const double n = static_cast<double>(readings.size());
  Candidate candidate;
  candidate.H = Eigen::VectorXd::Zero(P_.rows());
  candidate.H[3 + row] = 1.0;
  double incidence = 1.0, across_m = 0.0;
  std::vector<double> residuals_m;
  for (const Past& past : readings) {
    const Beam beam = beamOf(past);
    const ExpectedRange expected = expectedRange(wall, beam);
    if (expected.incidence <= 0.0 || expected.range_m <= 0.0) return candidate;
    incidence = std::min(incidence, expected.incidence);
    across_m = std::max(across_m, expected.across_m);
    candidate.range_m = expected.range_m;
    residuals_m.push_back(past.reading.range_m - expected.range_m - bias_[row]);
    candidate.residual_m += residuals_m.back() / n;
    const Eigen::Vector2d from_base = beam.p_map - T_map_base_.translation();
    candidate.H.head<2>() += expected.by_position / n;
    candidate.H[2] += (expected.by_position.dot(turned(from_base)) + expected.by_direction_m_rad) / n;
  }
  candidate.noise = std::pow(params_.reading_sigma_m, 2) / n + std::pow(kAcrossShare * across_m, 2) +
                    (std::pow(params_.wall_sigma_m, 2) + std::pow(wall.sigma_m, 2)) / (incidence * incidence);
  candidate.variance = candidate.H.dot(P_ * candidate.H) + candidate.noise;
  judge(candidate, residuals_m);
  return candidate;
}

/// By the mean of the residuals, if they scatter no more about it than readings and wall do: what stands
/// elsewhere, or moves with the robot as the floor does, comes nearer by another way than the robot's.
void RangeCorrector::judge(Candidate& candidate, const std::vector<double>& residuals_m) const {
  const double own = candidate.noise + std::pow(params_.reading_sigma_m, 2);
  double scatter = 0.0;
  for (const double residual_m : residuals_m) scatter += std::pow(residual_m - candidate.residual_m, 2) / own;
  const int degrees = static_cast<int>(residuals_m.size()) - 1;
  if (degrees > 0 && scatter > largestSum(degrees)) return;
  candidate.likelihood = std::exp(-0.5 * candidate.residual_m * candidate.residual_m / candidate.variance) /
                         std::sqrt(2.0 * kPi * candidate.variance);
}

void RangeCorrector::correct(const Candidate& candidate) {
  const Eigen::VectorXd K = P_ * candidate.H / candidate.variance;
  const Eigen::VectorXd shift = K * candidate.residual_m;
  T_map_base_.translation() += shift.head<2>();
  T_map_base_.linear() = Eigen::Rotation2Dd(yawOf(T_map_base_) + shift[2]).toRotationMatrix();
  bias_ += shift.tail(bias_.size());
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(P_.rows(), P_.cols()) - K * candidate.H.transpose();
  P_ = (left * P_ * left.transpose() + candidate.noise * K * K.transpose()).eval();
}

}  // namespace stereo_nav::estimation
