#include "estimation/range_correction/range_corrector.h"

#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::estimation {
namespace {

constexpr double kCertain = 0.95;

/// A vector turned by 90 degrees: what it changes by with the yaw.
Eigen::Vector2d turned(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

}  // namespace

RangeCorrector::RangeCorrector(const RangeParams& params, std::size_t sensors)
    : params_(params),
      finders_(sensors),
      bias_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sensors))),
      P_(Eigen::MatrixXd::Identity(3 + bias_.size(), 3 + bias_.size()) * std::pow(params.bias_sigma_m, 2)) {}

void RangeCorrector::setPose(const Eigen::Isometry2d& T_map_base, const Eigen::Matrix3d& covariance) {
  T_map_base_ = T_map_base;
  P_.topRows<3>().setZero();
  P_.leftCols<3>().setZero();
  P_.topLeftCorner<3, 3>() = covariance;
  for (Finder& finder : finders_) finder = {};
}

RangeOutcome RangeCorrector::add(const RangeReading& reading, const Eigen::Isometry2d& T_odom_base) {
  moveTo(reading.time_s, T_odom_base);
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

void RangeCorrector::moveTo(double time_s, const Eigen::Isometry2d& T_odom_base) {
  if (moving_) {
    const Eigen::Isometry2d motion = T_odom_base_.inverse() * T_odom_base;
    const Eigen::Vector2d way = T_map_base_.linear() * motion.translation();
    T_map_base_ = T_map_base_ * motion;
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(P_.rows(), P_.cols());
    F.block<2, 1>(0, 2) = turned(way);
    P_ = (F * P_ * F.transpose()).eval();
    const double way_m = way.norm(), turn_rad = std::abs(yawOf(motion));
    P_(0, 0) += std::pow(params_.way_noise_m, 2) * way_m;
    P_(1, 1) += std::pow(params_.way_noise_m, 2) * way_m;
    P_(2, 2) += std::pow(params_.turn_noise_rad, 2) * (way_m + turn_rad);
    const double walked = std::pow(params_.bias_walk_m, 2) * std::abs(time_s - time_s_);
    P_.diagonal().tail(bias_.size()).array() += walked;
  }
  moving_ = true;
  time_s_ = time_s;
  T_odom_base_ = T_odom_base;
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
  const Past& newest = finders_[sensor].readings.back();
  const double range_m = newest.reading.max_range_m;
  const std::vector<SeenWall> walls = wallsOf(map_, beamOf(newest), std::sqrt(P_(2, 2)), 1.5 * range_m);
  if (walls.empty()) return RangeOutcome::kForeign;
  const double share = (1.0 - params_.foreign_share) / static_cast<double>(walls.size());
  const double foreign = params_.foreign_share / range_m;
  double sum = foreign, largest = 0.0;
  Candidate best;
  for (const SeenWall& wall : walls) {
    const Candidate candidate = candidateOf(wall, sensor);
    const double weight = share * candidate.likelihood;
    sum += weight;
    if (weight <= largest) continue;
    largest = weight;
    best = candidate;
  }
  if (foreign > largest) return RangeOutcome::kForeign;
  if (largest < kCertain * sum) return RangeOutcome::kAmbiguous;
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
  double incidence = 1.0;
  for (const Past& past : readings) {
    const Beam beam = beamOf(past);
    const ExpectedRange expected = expectedRange(wall, beam);
    if (expected.incidence <= 0.0 || expected.range_m <= 0.0) return candidate;
    incidence = std::min(incidence, expected.incidence);
    candidate.residual_m += (past.reading.range_m - expected.range_m - bias_[row]) / n;
    const Eigen::Vector2d from_base = beam.p_map - T_map_base_.translation();
    candidate.H.head<2>() += expected.by_position / n;
    candidate.H[2] += (expected.by_position.dot(turned(from_base)) + expected.by_direction_m_rad) / n;
  }
  candidate.noise = std::pow(params_.reading_sigma_m, 2) / n +
                    (std::pow(params_.wall_sigma_m, 2) + std::pow(wall.sigma_m, 2)) / (incidence * incidence);
  candidate.variance = candidate.H.dot(P_ * candidate.H) + candidate.noise;
  candidate.likelihood = std::exp(-0.5 * candidate.residual_m * candidate.residual_m / candidate.variance) /
                         std::sqrt(2.0 * kPi * candidate.variance);
  return candidate;
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
