#include "calibration/imu_camera_rotation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/turns.h"
#include "core/angles.h"
#include "core/statistics.h"

namespace stereo_nav::calibration {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// Rotation, bias and remaining cost for one offset of the stamps.
struct Alignment {
  Eigen::Matrix3d R_camera_imu = Eigen::Matrix3d::Identity();
  Eigen::Vector3d bias_rad_s = Eigen::Vector3d::Zero();
  double cost = std::numeric_limits<double>::infinity();           ///< mean squared difference of rates
  double mirrored_cost = std::numeric_limits<double>::infinity();  ///< ... if the IMU's axes were left-handed
};

/// The closed form: a constant bias cancels when the mean is subtracted from both rates.
Alignment align(const std::vector<Turn>& turns, const ImuTurns& imu, double offset_s) {
  std::vector<Eigen::Vector3d> camera_rates, imu_rates;
  for (const Turn& turn : turns) {
    const auto imu_turn = imu.turn(turn, offset_s);
    if (!imu_turn) continue;
    camera_rates.push_back(turn.angle_rad / turn.duration_s());
    imu_rates.push_back(*imu_turn / turn.duration_s());
  }
  Alignment result;
  if (2 * camera_rates.size() < turns.size()) return result;
  const auto n = static_cast<double>(camera_rates.size());
  Eigen::Vector3d camera_mean = Eigen::Vector3d::Zero(), imu_mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < camera_rates.size(); ++i) {
    camera_mean += camera_rates[i] / n;
    imu_mean += imu_rates[i] / n;
  }
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  double energy = 0.0;
  for (std::size_t i = 0; i < camera_rates.size(); ++i) {
    const Eigen::Vector3d c = camera_rates[i] - camera_mean, m = imu_rates[i] - imu_mean;
    correlation += c * m.transpose() / n;
    energy += (c.squaredNorm() + m.squaredNorm()) / n;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Vector3d signs(1.0, 1.0, handedness);
  const Eigen::Vector3d& s = svd.singularValues();
  result.R_camera_imu = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  result.bias_rad_s = imu_mean - result.R_camera_imu.transpose() * camera_mean;
  result.cost = energy - 2.0 * (s(0) + s(1) + handedness * s(2));
  result.mirrored_cost = energy - 2.0 * (s(0) + s(1) - handedness * s(2));
  return result;
}

/// One state of the refinement and its residuals.
struct Fit {
  Eigen::Matrix3d R_camera_imu;
  Eigen::Vector3d bias_rad_s;
  double offset_s;
};

struct Linearised {
  Matrix7d information = Matrix7d::Zero();  ///< turn of R_camera_imu, bias, offset
  Vector7d gradient = Vector7d::Zero();
  double squares = 0.0, weights = 0.0;
  std::size_t turns = 0;
};

Eigen::Vector3d residualOf(const Fit& fit, const Turn& turn, const Eigen::Vector3d& imu_turn) {
  return turn.angle_rad - fit.R_camera_imu * (imu_turn - fit.bias_rad_s * turn.duration_s());
}

Linearised linearise(const std::vector<Turn>& turns, const ImuTurns& imu, const Fit& fit, double scale_rad) {
  constexpr double kStep_s = 5e-3;
  Linearised result;
  for (const Turn& turn : turns) {
    const auto now = imu.turn(turn, fit.offset_s), before = imu.turn(turn, fit.offset_s - kStep_s),
               after = imu.turn(turn, fit.offset_s + kStep_s);
    if (!now || !before || !after) continue;
    const Eigen::Vector3d residual = residualOf(fit, turn, *now);
    Eigen::Matrix<double, 3, 7> jacobian;
    jacobian.leftCols<3>() = hat(turn.angle_rad - residual);
    jacobian.middleCols<3>(3) = turn.duration_s() * fit.R_camera_imu;
    jacobian.col(6) = -fit.R_camera_imu * (*after - *before) / (2.0 * kStep_s);
    const double weight = 1.0 / (1.0 + residual.squaredNorm() / (scale_rad * scale_rad));
    result.information += weight * jacobian.transpose() * jacobian;
    result.gradient += weight * jacobian.transpose() * residual;
    result.squares += weight * residual.squaredNorm();
    result.weights += weight;
    ++result.turns;
  }
  return result;
}

/// Robust spread of the residuals' lengths.
double spreadOf(const std::vector<Turn>& turns, const ImuTurns& imu, const Fit& fit) {
  std::vector<double> lengths;
  for (const Turn& turn : turns) {
    const auto imu_turn = imu.turn(turn, fit.offset_s);
    if (imu_turn) lengths.push_back(residualOf(fit, turn, *imu_turn).norm());
  }
  if (lengths.empty()) return 1.0;
  constexpr double kLeast_rad = 0.02 * kRadPerDeg;
  return std::max(upperMedian(lengths), kLeast_rad);
}

Fit refine(const std::vector<Turn>& turns, const ImuTurns& imu, Fit fit, ImuCameraRotation& result) {
  constexpr int kIterations = 15;
  Linearised last;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    last = linearise(turns, imu, fit, 2.0 * spreadOf(turns, imu, fit));
    if (iteration == kIterations) break;
    // Turns about one axis leave directions undetermined: the smallest step then, where gaussNewtonStep()
    // gives none.
    const Vector7d step = -last.information.completeOrthogonalDecomposition().solve(last.gradient);
    fit.R_camera_imu = expRotation(step.head<3>()) * fit.R_camera_imu;
    fit.bias_rad_s += step.segment<3>(3);
    fit.offset_s += std::clamp(step(6), -0.02, 0.02);
  }
  const double variance = last.squares / std::max(3.0 * last.weights - 7.0, 1.0);
  result.turns = last.turns;
  result.residual_rms_rad = std::sqrt(last.squares / std::max(last.weights, 1e-9));
  const Eigen::FullPivLU<Matrix7d> lu(last.information);
  if (lu.isInvertible()) {
    const Matrix7d covariance = variance * lu.inverse();
    result.sigma_rad = covariance.diagonal().head<3>().cwiseMax(0.0).cwiseSqrt();
    result.imu_offset_sigma_s = std::sqrt(std::max(covariance(6, 6), 0.0));
  }
  return fit;
}

/// Determines about which axes the camera turned, and how fast.
void describeMotion(const std::vector<Turn>& turns, ImuCameraRotation& result) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  const auto n = static_cast<double>(turns.size());
  for (const Turn& turn : turns) {
    const Eigen::Vector3d rate = turn.angle_rad / turn.duration_s();
    scatter += rate * rate.transpose() / n;
    squares += turn.angle_rad.squaredNorm() / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  result.rate_rms_rad_s = solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  result.motion_axes = solver.eigenvectors().rowwise().reverse();
  result.turn_rms_rad = std::sqrt(squares);
}

}  // namespace

ImuCameraRotation calibrateImuCameraRotation(const std::vector<CameraOrientation>& camera,
                                             const std::vector<ImuSample>& imu_samples,
                                             const ImuCameraRotationParams& params) {
  ImuCameraRotation result;
  const std::vector<Turn> turns = turnsOf(camera, params.interval_s);
  result.turns = turns.size();
  result.refusal = refuseData(turns, imu_samples, params);
  if (!result.usable()) return result;
  describeMotion(turns, result);

  const ImuTurns imu(imu_samples, Eigen::Vector3d::Zero());
  constexpr double kGrid_s = 0.01;
  Alignment best;
  const int steps = static_cast<int>(std::lround(params.max_offset_s / kGrid_s));
  for (int step = -steps; step <= steps; ++step) {
    const Alignment alignment = align(turns, imu, step * kGrid_s);
    if (!(alignment.cost < best.cost)) continue;
    best = alignment;
    result.imu_offset_s = step * kGrid_s;
  }
  Fit fit{best.R_camera_imu, best.bias_rad_s, result.imu_offset_s};
  // The bias is first subtracted from the turns, to first order; once known, from the rates themselves.
  const bool from_rates = !imu_samples.front().q_world_imu;
  for (int pass = 0; pass < (from_rates ? 3 : 1); ++pass) {
    if (from_rates) {
      result.bias_rad_s += fit.bias_rad_s;
      fit.bias_rad_s.setZero();
    }
    fit = refine(turns, ImuTurns(imu_samples, result.bias_rad_s), fit, result);
  }
  result.R_camera_imu = fit.R_camera_imu;
  result.bias_rad_s += fit.bias_rad_s;
  result.imu_offset_s = fit.offset_s;
  const bool mirrored = best.mirrored_cost < 0.25 * best.cost;
  result.refusal = refuseResult(result, mirrored, params);
  return result;
}

void ImuCameraRotationParams::describe(ParameterVisitor& visitor) {
  visitor.real("interval_s", interval_s, {0.02, 5.0}, "s", "time over which turns are compared");
  visitor.real("max_offset_s", max_offset_s, {0.0, 2.0}, "s",
               "largest error of the IMU's stamps that is searched for");
  visitor.real("min_rate_deg_s", min_rate_deg_s, {0.0, 1000.0}, "deg/s",
               "RMS rate about the second of the motion's axes, below which the motion has too few axes");
  visitor.real("max_sigma_deg", max_sigma_deg, {0.0, 180.0}, "deg", "largest uncertainty that is accepted");
  visitor.real("max_residual_share", max_residual_share, {0.0, 1.0}, "",
               "largest disagreement of the two turns, as a share of them");
  visitor.integer("min_turns", min_turns, {3, 100000}, "", "fewest intervals with a turn by both");
}

}  // namespace stereo_nav::calibration
