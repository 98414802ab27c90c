#include "odometry/laser/laser_odometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "core/statistics.h"
#include "odometry/laser/correlative_search.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {
namespace {

constexpr std::size_t kLeastPoints = 20;
constexpr double kMostTilt_deg = 20.0;  // beyond it distances in the plane are off by more than 6 %
/// Good scans in succession that do not fit the map: it is that of another place.
constexpr int kMostMisfits = 10;
/// A scan that fits so well is believed though the prior makes it unlikely: the robot slipped, or was pushed.
constexpr double kCertainShare = 0.4;
constexpr double kCertainScale = 2.0;
constexpr double kMostSurprise = 16.0;
/// Residuals that are so much larger than the laser's noise are no fit.
constexpr double kMostResidualScale = 2.5;
/// Residuals larger than that, or a shift that one of a hundred good priors makes necessary, may come from a
/// wrong minimum, which a search finds out of.
constexpr double kDoubtfulScale = 1.5;
constexpr double kDoubtfulSurprise = 11.3;
/// By which a pose must fit better that is further from the prior than one which fits: the map may hold a
/// place twice.
constexpr double kBetterShare = 0.15;
/// A prior that is less certain than this may lie beyond the reach of Gauss-Newton.
constexpr double kVague_m = 0.15;
constexpr double kVague_rad = 0.07;

/// How likely a pose is, by the points on the map and by the prior, as the search weighs them.
double scoreOf(const Registration& registration) {
  return searchScore(registration.inlier_share, registration.surprise);
}

LaserParams checkedLaser(const LaserParams& params) {
  validateParameters(params, "laser odometry");
  return params;
}

std::string describeUntold(const std::vector<Eigen::Vector3d>& untold) {
  std::string text;
  for (const Eigen::Vector3d& motion : untold) {
    if (!text.empty()) text += " and ";
    text += std::abs(motion.z()) > 0.7
                ? std::string("the rotation")
                : fmt::format("the motion along {:.0f} deg",
                              wrapDegrees(2.0 * kDegPerRad * std::atan2(motion.y(), motion.x())) / 2.0);
  }
  return "no wall in reach tells " + text;
}

}  // namespace

LaserOdometry::LaserOdometry(const LaserParams& params)
    : params_(checkedLaser(params)), filter_(params_), map_(params_.cell_m, params_.keyframes) {}

void LaserOdometry::setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance) {
  filter_.setPose(T_odom_base, covariance);
  map_.clear();
  rest_ = RestWatch();
}

void LaserOdometry::check(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser) const {
  if (last_s_ && !(scan.time_s > *last_s_)) {
    throw InputError(fmt::format(
        "the stamp {:.6f} s of the scan is not later than the last one, {:.6f} s; scans must come in "
        "order of time, each once",
        scan.time_s, *last_s_));
  }
  const double tilt_deg = kDegPerRad * std::acos(std::min(1.0, std::abs(T_base_laser(2, 2))));
  if (tilt_deg > kMostTilt_deg) {
    throw InputError(fmt::format(
        "the laser is mounted with a tilt of {:.0f} deg, at most are {:.0f}: the plane of its beams must "
        "be that of the floor; correct its transform in tf, or mount it level",
        tilt_deg, kMostTilt_deg));
  }
}

LaserOdometryResult LaserOdometry::process(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser) {
  check(scan, T_base_laser);
  const FilterMoment before = momentOf(filter_);
  filter_.beginStep();
  LaserOdometryResult result;
  result.time_s = scan.time_s;
  if (params_.method == LaserMethod::kRangeFlow) {
    followFlow(scan, T_base_laser, result);
  } else {
    match(scan, T_base_laser, result);
  }
  complete(before, result);
  last_s_ = scan.time_s;
  return result;
}

void LaserOdometry::followFlow(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser,
                               LaserOdometryResult& result) {
  const double duration_s = last_s_ ? scan.time_s - *last_s_ : 0.0;
  const LaserVelocity velocity = flow_.follow(rangeScanOf(scan, T_base_laser), duration_s);
  result.points = pointsOf(scan, T_base_laser).points.size();
  result.inlier_share = velocity.inlier_share;
  result.state = LaserOdometryResult::State::kTracking;
  if (!last_s_) return;
  if (velocity.inlier_share == 0.0) {
    result.state = LaserOdometryResult::State::kCoasting;
    result.reason = "too few beams have a range in this scan and in the one before; is the laser covered?";
  }
  // The axes at the laser's place are those of the base.
  Eigen::Isometry2d T_base_axes = Eigen::Isometry2d::Identity();
  T_base_axes.translation() = T_base_laser.translation().head<2>();
  const Eigen::Matrix3d to_base = duration_s * adjointPlanar(T_base_axes);
  filter_.move(expPlanar(to_base * velocity.mean), to_base * velocity.covariance * to_base.transpose());
}

void LaserOdometry::match(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser,
                          LaserOdometryResult& result) {
  const MeasuredMotion during = inputs_.between(scan.time_s, scan.time_s + scan.sweep_s());
  // Before the first scan there is no motion, but its sources.
  const MeasuredMotion since = last_s_ ? inputs_.between(*last_s_, scan.time_s)
                                       : MeasuredMotion{{}, during.translation, during.rotation};
  filter_.predict(since, coasting_s_);
  const Sweep sweep(filter_, during);
  const LaserPoints points = pointsOf(scan, T_base_laser);
  result.wheels = since.translation == RateSource::kWheels;
  result.gyroscope = since.rotation == RateSource::kGyro;
  result.points = points.points.size();
  if (points.points.size() < kLeastPoints) {
    result.reason =
        fmt::format("{} of {} beams have a return, needed are {}; is the laser covered, or nothing in reach?",
                    points.points.size(), scan.ranges_m.size(), kLeastPoints);
  } else {
    lay(points, sweep, result);
  }
  const bool coasts = result.state == LaserOdometryResult::State::kCoasting;
  coasting_ = coasts ? coasting_ + 1 : 0;
  coasting_s_ = coasts && last_s_ ? coasting_s_ + scan.time_s - *last_s_ : 0.0;
}

void LaserOdometry::lay(const LaserPoints& points, const Sweep& sweep, LaserOdometryResult& result) {
  using State = LaserOdometryResult::State;
  if (map_.empty()) {
    result.state = State::kTracking;
    addKeyframe(points, sweep, {});
    result.keyframe = true;
    return;
  }
  Registration registration = registerOrSearch(points, sweep);
  if (refusal(registration).empty() && registration.surprise > kMostSurprise) {
    filter_.judgeNoise(registration.shift, registration.covariance, registration.directions.untold.empty());
    filter_.distrustPrior(registration.surprise / 3.0);
    registration = registerOrSearch(points, sweep);
  }
  result.inlier_share = registration.inlier_share;
  result.residual_scale = registration.residual_scale;
  result.least_share = registration.directions.least_share;
  result.registration = registration;
  result.reason = refusal(registration);
  if (!result.reason.empty()) {
    if (coasting_ < kMostMisfits) return;
    map_.clear();
    filter_.restartMap();
    addKeyframe(points, sweep, {});
    return;
  }
  result.state = registration.directions.untold.empty() ? State::kTracking : State::kPartly;
  result.untold = registration.directions.untold;
  if (!result.untold.empty()) result.reason = describeUntold(result.untold);
  filter_.judgeNoise(registration.shift, registration.covariance, registration.directions.untold.empty());
  filter_.update(registration.shift, registration.covariance, registration.contraction);
  if (!isKeyframe()) return;
  result.keyframe = true;
  addKeyframe(points, sweep, registration);
}

Registration LaserOdometry::registerOrSearch(const LaserPoints& points, const Sweep& sweep) {
  const PlanarState& prior = filter_.state();
  const Matrix6d covariance = filter_.relativeCovariance();
  const bool vague =
      covariance(0, 0) + covariance(1, 1) > kVague_m * kVague_m || covariance(2, 2) > kVague_rad * kVague_rad;
  const Registration direct = registerScan(points, sweep, map_, prior, covariance, params_);
  const bool doubtful = direct.residual_scale > kDoubtfulScale || direct.surprise > kDoubtfulSurprise ||
                        !refusal(direct).empty();
  if (!doubtful && (!vague || direct.inlier_share > 1.0 - kBetterShare)) return direct;
  std::vector<Eigen::Vector2d> points_base;
  sweep.undistort(points, prior.correction, points_base);
  raster_.draw(map_, prior.p_odom);
  std::vector<Eigen::Vector3d> starts =
      searchShifts(points_base, raster_, prior, covariance.topLeftCorner<3, 3>());
  starts.emplace_back(Eigen::Vector3d::Zero());  // the prior itself, but with the walls right beside it
  Registration best = direct;
  for (const Eigen::Vector3d& start : starts) {
    const Registration found = registerScan(points, sweep, map_, prior, covariance, params_, start);
    const bool allowed = doubtful || found.surprise <= direct.surprise ||
                         found.inlier_share > direct.inlier_share + kBetterShare;
    if (allowed && scoreOf(found) > scoreOf(best)) best = found;
  }
  return best;
}

std::string LaserOdometry::refusal(const Registration& registration) const {
  if (!(registration.inlier_share >= params_.least_inlier_share)) {
    return fmt::format(
        "{:.0f} % of the points lie on the map, needed are {:.0f} %; is the laser disturbed or hidden?",
        100.0 * registration.inlier_share, 100.0 * params_.least_inlier_share);
  }
  if (registration.residual_scale > kMostResidualScale)
    return fmt::format("the points lie {:.1f} times as far from the map as the laser's noise explains",
                       registration.residual_scale);
  const bool certain =
      registration.inlier_share > kCertainShare && registration.residual_scale < kCertainScale;
  if (registration.surprise > kMostSurprise && !certain)
    return fmt::format("the scan fits best where the prior makes it unlikely (chi-square {:.0f})",
                       registration.surprise);
  return "";
}

bool LaserOdometry::isKeyframe() const {
  const Eigen::Isometry2d T_keyframe_base = T_odom_keyframe_.inverse() * filter_.state().T_odom_base();
  const double turn_rad = std::abs(yawOf(T_keyframe_base));
  return T_keyframe_base.translation().norm() > params_.keyframe_distance_m ||
         turn_rad > params_.keyframe_turn_deg * kRadPerDeg;
}

void LaserOdometry::addKeyframe(const LaserPoints& points, const Sweep& sweep,
                                const Registration& registration) {
  const PlanarState& state = filter_.state();
  T_odom_keyframe_ = state.T_odom_base();
  std::vector<Eigen::Vector2d> points_odom;
  sweep.undistort(points, state.correction, points_odom);
  for (Eigen::Vector2d& p : points_odom) p = T_odom_keyframe_ * p;
  const bool first = map_.empty();
  map_.add(points_odom);
  // The mean of the last n keyframes follows 2 / (n + 1) of each new one's error. Neighbours look at the same
  // pieces of wall: three of them count as one.
  const double share = first ? 1.0 : 2.0 / (registration.keyframes / 3.0 + 2.0);
  filter_.mixIntoMap(share, first ? Eigen::Matrix3d::Zero() : registration.scan_covariance);
}

void LaserOdometry::complete(const FilterMoment& before, LaserOdometryResult& result) {
  const FilterMoment now = momentOf(filter_);
  result.T_odom_base = now.T_odom_base;
  result.pose_covariance = filter_.poseCovariance();
  result.at_rest = rest_.observe(result.time_s, result.T_odom_base);
  if (!last_s_) return;
  const double duration_s = result.time_s - *last_s_;
  result.twist = logPlanar(before.T_odom_base.inverse() * now.T_odom_base) / duration_s;
  result.twist_covariance = motionCovariance(before, filter_.transition(), now) / (duration_s * duration_s);
}

}  // namespace stereo_nav::odometry
