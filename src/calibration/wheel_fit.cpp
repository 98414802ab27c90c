#include "calibration/wheel_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::calibration {
namespace {

constexpr Eigen::Index kPerWheel = 4;
constexpr double kHuber = 4.0;
constexpr double kStep = 0.01;  // of the numeric derivatives, in units of what is assumed
constexpr int kMostIterations = 20;

/// Normalised errors beyond this count linearly: a bump, a wheel that spun.
double huberLimit(const Eigen::VectorXd& error) {
  return kHuber * std::sqrt(static_cast<double>(error.size()) / 3.0);
}

double huber(const Eigen::VectorXd& error) {
  const double norm = error.norm(), limit = huberLimit(error);
  return norm <= limit ? norm * norm : 2.0 * limit * norm - limit * limit;
}

double huberWeight(const Eigen::VectorXd& error) {
  const double norm = error.norm(), limit = huberLimit(error);
  return norm <= limit ? 1.0 : limit / norm;
}

/// Fixed wheels stay on one axle, without which the drive could not move: the axle is moved along and turned
/// as `axle`, the unknowns of its first wheel, says; the wheel itself moves across.
void moveOnAxle(const Eigen::Vector4d& axle, const Eigen::Vector2d& shift, kinematics::WheelParams& wheel) {
  const double angle_rad = wheel.direction_deg * kRadPerDeg;
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d widened = Eigen::Vector2d(wheel.x_m, wheel.y_m) + across * across.dot(shift);
  const Eigen::Vector2d moved = Eigen::Rotation2Dd(axle(3)) * widened + along * along.dot(axle.segment<2>(1));
  wheel.x_m = moved.x();
  wheel.y_m = moved.y();
  wheel.direction_deg += axle(3) * kDegPerRad;
}

}  // namespace

WheelFit::WheelFit(const WheelWindows& windows, const odometry::WheelOdometryParams& nominal,
                   std::size_t runs, const WheelCalibrationParams& params)
    : windows_(windows), nominal_(nominal), params_(params) {
  const auto wheels = static_cast<Eigen::Index>(nominal.drive.wheels.size());
  sigmas_.resize(kPerWheel * wheels + 1 + static_cast<Eigen::Index>(runs));
  for (Eigen::Index w = 0; w < wheels; ++w)
    sigmas_.segment<kPerWheel>(kPerWheel * w) << params.radius_sigma, params.position_sigma_m,
        params.position_sigma_m, params.direction_sigma_deg * kRadPerDeg;
  sigmas_(kPerWheel * wheels) = params.reference_scale_sigma;
  sigmas_.tail(static_cast<Eigen::Index>(runs)).setConstant(params.time_offset_sigma_s);
  unknowns_.setZero(sigmas_.size());
  covariance_.setIdentity(sigmas_.size(), sigmas_.size());
  setErrors(nominal);
}

kinematics::DriveParams WheelFit::driveOf(const Eigen::VectorXd& unknowns) const {
  kinematics::DriveParams drive = nominal_.drive;
  const Eigen::VectorXd values = unknowns.cwiseProduct(sigmas_);
  std::optional<Eigen::Index> axle;  // unknowns of the first fixed wheel
  for (std::size_t w = 0; w < drive.wheels.size(); ++w) {
    kinematics::WheelParams& wheel = drive.wheels[w];
    const Eigen::Index first = kPerWheel * static_cast<Eigen::Index>(w);
    wheel.radius_m *= std::exp(values(first));
    const Eigen::Vector2d shift = values.segment<2>(first + 1);
    if (wheel.kind == kinematics::WheelKind::kFixed) {
      axle = axle.value_or(first);
      moveOnAxle(values.segment<kPerWheel>(*axle), shift, wheel);
      continue;
    }
    wheel.x_m += shift.x();
    wheel.y_m += shift.y();
    wheel.direction_deg += values(first + 3) * kDegPerRad;
  }
  return drive;
}

double WheelFit::referenceScale() const {
  const Eigen::Index index = kPerWheel * static_cast<Eigen::Index>(nominal_.drive.wheels.size());
  return 1.0 + unknowns_(index) * sigmas_(index);
}

double WheelFit::timeOffset_s(std::size_t run) const {
  const Eigen::Index index = kPerWheel * static_cast<Eigen::Index>(nominal_.drive.wheels.size()) + 1 +
                             static_cast<Eigen::Index>(run);
  return unknowns_(index) * sigmas_(index);
}

Eigen::MatrixXd WheelFit::wheelCovariance() const {
  const Eigen::Index n = kPerWheel * static_cast<Eigen::Index>(nominal_.drive.wheels.size());
  const Eigen::MatrixXd scale = sigmas_.head(n).asDiagonal();
  return scale * covariance_.topLeftCorner(n, n) * scale;
}

Eigen::Vector3d WheelFit::error(const WheelWindows& windows, const WheelWindows::Window& window,
                                const WheelWindows::Motion& by_wheels,
                                const Eigen::VectorXd& unknowns) const {
  const Eigen::Index scale = kPerWheel * static_cast<Eigen::Index>(nominal_.drive.wheels.size());
  const Eigen::Index offset = scale + 1 + static_cast<Eigen::Index>(window.run);
  const double most_s = 3.0 * params_.time_offset_sigma_s;
  Eigen::Isometry2d reference =
      windows.byReference(window, std::clamp(unknowns(offset) * sigmas_(offset), -most_s, most_s));
  reference.translation() *= 1.0 + unknowns(scale) * sigmas_(scale);
  return logPlanar(by_wheels.T_start_end.inverse() * reference);
}

Eigen::Matrix3d WheelFit::covariance(const WheelWindows& windows, const WheelWindows::Window& window,
                                     const odometry::WheelOdometryParams& errors) const {
  const Eigen::Isometry2d reference = windows.byReference(window, 0.0);
  const Eigen::Vector3d noise(params_.reference_sigma_m, params_.reference_sigma_m,
                              params_.reference_sigma_deg * kRadPerDeg);
  const Eigen::Vector3d walk(params_.reference_walk_m, params_.reference_walk_m,
                             params_.reference_walk_deg * kRadPerDeg);
  const Eigen::Matrix3d at_end = noise.cwiseAbs2().asDiagonal();
  const Eigen::Matrix3d carry = adjointPlanar(reference.inverse());
  Eigen::Matrix3d result = windows.covariance(window, errors) + at_end + carry * at_end * carry.transpose();
  result.diagonal() += reference.translation().norm() * walk.cwiseAbs2();
  return result;
}

void WheelFit::setErrors(const odometry::WheelOdometryParams& errors) {
  odometry::WheelOdometryParams without_scale = errors;
  without_scale.scale_sigma = 0.0;  // the radii are unknowns here
  errors_ = without_scale;
  whitening_.clear();
  for (const auto& window : windows_.windows()) {
    const Eigen::LLT<Eigen::Matrix3d> root(covariance(windows_, window, without_scale));
    whitening_.push_back(root.matrixL().solve(Eigen::Matrix3d::Identity()));
  }
}

std::vector<Eigen::VectorXd> WheelFit::whitened(const Eigen::VectorXd& unknowns) const {
  const kinematics::Drive drive(driveOf(unknowns));
  std::vector<Eigen::VectorXd> errors;
  for (std::size_t k = 0; k < windows_.windows().size(); ++k) {
    const WheelWindows::Window& window = windows_.windows()[k];
    const WheelWindows::Motion motion = windows_.byWheels(window, drive, errors_);
    Eigen::VectorXd all(3 + motion.contradictions.size());
    all << whitening_[k] * error(windows_, window, motion, unknowns), motion.contradictions;
    errors.push_back(std::move(all));
  }
  return errors;
}

double WheelFit::cost(const Eigen::VectorXd& unknowns) const {
  double sum = unknowns.squaredNorm();
  for (const auto& error : whitened(unknowns)) sum += huber(error);
  return sum;
}

void WheelFit::linearise(Eigen::MatrixXd& information, Eigen::VectorXd& gradient) const {
  const std::vector<Eigen::VectorXd> errors = whitened(unknowns_);
  std::vector<Eigen::MatrixXd> jacobians;
  for (const auto& error : errors)
    jacobians.emplace_back(Eigen::MatrixXd::Zero(error.size(), unknowns_.size()));
  for (Eigen::Index i = 0; i < unknowns_.size(); ++i) {
    if (sigmas_(i) == 0.0) continue;
    Eigen::VectorXd moved = unknowns_;
    moved(i) += kStep;
    const auto above = whitened(moved);
    moved(i) -= 2.0 * kStep;
    const auto below = whitened(moved);
    for (std::size_t k = 0; k < errors.size(); ++k)
      jacobians[k].col(i) = (above[k] - below[k]) / (2.0 * kStep);
  }
  information.setIdentity(unknowns_.size(), unknowns_.size());
  gradient = unknowns_;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double weight = huberWeight(errors[k]);
    information += weight * jacobians[k].transpose() * jacobians[k];
    gradient += weight * jacobians[k].transpose() * errors[k];
  }
}

void WheelFit::solve() {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  double damping = 0.0;
  double cost_now = cost(unknowns_);
  for (int i = 0; i < kMostIterations; ++i) {
    linearise(information, gradient);
    const Eigen::MatrixXd diagonal = information.diagonal().asDiagonal();
    Eigen::VectorXd step = (information + damping * diagonal).ldlt().solve(-gradient);
    double cost_next = cost(unknowns_ + step);
    while (cost_next > cost_now && step.norm() > 1e-6) {
      damping = std::max(1e-3, 10.0 * damping);
      step = (information + damping * diagonal).ldlt().solve(-gradient);
      cost_next = cost(unknowns_ + step);
    }
    if (cost_next <= cost_now) unknowns_ += step;
    damping *= 0.1;
    const bool done = cost_now - cost_next < 1e-6 * cost_now;
    cost_now = std::min(cost_now, cost_next);
    if (done) break;
  }
  linearise(information, gradient);
  covariance_ = information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

double WheelFit::meanSquare(const WheelWindows& windows, const odometry::WheelOdometryParams& params) const {
  const kinematics::Drive drive(driveOf(unknowns_));
  double sum = 0.0;
  for (const auto& window : windows.windows()) {
    const Eigen::Vector3d e = error(windows, window, windows.byWheels(window, drive, params), unknowns_);
    sum += e.dot(covariance(windows, window, params).ldlt().solve(e)) / 3.0;
  }
  return sum / static_cast<double>(windows.windows().size());
}

WheelAgreement WheelFit::agreement(bool nominal) const {
  Eigen::VectorXd unknowns = unknowns_;
  if (nominal) unknowns.head(kPerWheel * static_cast<Eigen::Index>(nominal_.drive.wheels.size())).setZero();
  const kinematics::Drive drive(driveOf(unknowns));
  double metres = 0.0, radians = 0.0;
  for (const auto& window : windows_.windows()) {
    const Eigen::Vector3d e = error(windows_, window, windows_.byWheels(window, drive, errors_), unknowns);
    metres += e.head<2>().squaredNorm();
    radians += e.z() * e.z();
  }
  const auto n = static_cast<double>(windows_.windows().size());
  return {std::sqrt(metres / n), std::sqrt(radians / n) * kDegPerRad};
}

}  // namespace stereo_nav::calibration
