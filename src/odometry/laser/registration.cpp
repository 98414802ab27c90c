#include "odometry/laser/registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/statistics.h"

namespace stereo_nav::odometry {
namespace {

constexpr int kMostIterations = 10;
constexpr double kConverged_m = 5e-4;
constexpr double kConverged_rad = 2e-4;
/// Residuals beyond this many standard deviations hardly count.
constexpr double kLossSigmas = 3.0;
/// What no point of a scan is better than: surfaces are rough.
constexpr double kRoughness_m = 0.004;
/// Of a start that was searched for, while lines are looked up: the finest ones, since coarser ones would
/// pull it to other walls beside.
constexpr double kStartSigma_m = 0.02;
constexpr double kStartSigma_rad = 0.005;
constexpr double kLeastVariance = 1e-12;

/// How wrong the pose may be while lines are looked up.
struct PoseUncertainty {
  double position_m2;
  double yaw_rad2;
};

PoseUncertainty uncertaintyOf(const Matrix6d& covariance) {
  return {0.5 * (covariance(0, 0) + covariance(1, 1)), covariance(2, 2)};
}

/// The normal equations of one linearisation, for a motion (forward, left, rotation) of the base.
struct NormalEquations {
  Eigen::Matrix3d M0 = Eigen::Matrix3d::Zero();  ///< sum of J^T W J
  Eigen::Matrix3d M1 = Eigen::Matrix3d::Zero();  ///< the same times the beam's time
  Eigen::Matrix3d M2 = Eigen::Matrix3d::Zero();  ///< and times its square
  Eigen::Vector3d g0 = Eigen::Vector3d::Zero();
  Eigen::Vector3d g1 = Eigen::Vector3d::Zero();
  ScanInformation information;
  double squared_levers = 0.0;
  double keyframes = 0.0;
  std::vector<double> squares;  ///< of the residuals, over their variances
};

using DynamicMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using DynamicVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// With variances that are not zero: a correction may have none.
DynamicMatrix inverted(const DynamicMatrix& matrix) {
  const auto n = matrix.rows();
  return DynamicMatrix(matrix + kLeastVariance * DynamicMatrix::Identity(n, n))
      .ldlt()
      .solve(DynamicMatrix::Identity(n, n));
}

/// What is told of the errors d (axes of odom) and c. The scale of wheels is told with the motion of its
/// axis: else the noise of the others would leak into it, for good. A velocity is learnt anew with every
/// scan.
struct Told {
  static constexpr double kLeak = 0.1;  // of the squared direction of an axis, that is not told

  Told(const ToldDirections& directions, const Eigen::Matrix3d& R_base_odom, bool scaled) {
    const Eigen::Index n = directions.basis.cols();
    Eigen::Vector3d untold = Eigen::Vector3d::Zero();
    if (scaled)
      for (const Eigen::Vector3d& direction : directions.untold) untold += direction.cwiseAbs2();
    const Eigen::Index told_axes = (untold.array() < kLeak).count();
    basis.setZero(6, n + told_axes);
    parts.setZero(n + told_axes, 6);
    basis.topLeftCorner(3, n) = R_base_odom.transpose() * directions.basis;
    parts.topLeftCorner(n, 3) = directions.parts * R_base_odom;
    for (Eigen::Index axis = 0, column = n; axis < 3; ++axis) {
      if (untold(axis) >= kLeak) continue;
      basis(3 + axis, column) = 1.0;
      parts(column++, 3 + axis) = 1.0;
    }
  }
  DynamicMatrix basis, parts;
};

class Registrar {
 public:
  Registrar(const LaserPoints& scan, const Sweep& sweep, const LineMap& map, const PlanarState& prior,
            const LaserParams& params)
      : scan_(scan), sweep_(sweep), map_(map), prior_(prior), params_(params), gain_(sweep.gain()) {}

  Registration run(const Matrix6d& prior_covariance, const std::optional<Eigen::Vector3d>& start) {
    Registration result;
    Matrix6d covariance = prior_covariance;
    if (start) {
      result.shift.head<3>() = *start;
      covariance.topLeftCorner<3, 3>() =
          Eigen::Vector3d(kStartSigma_m, kStartSigma_m, kStartSigma_rad).cwiseAbs2().asDiagonal();
    }
    bool converged = false;
    while (result.iterations < kMostIterations) {
      ++result.iterations;
      linearise(result.shift, uncertaintyOf(covariance));
      result.directions = toldDirections(equations_.information, params_.least_information_share);
      const Told told(result.directions, inBase(result.shift), sweep_.scaled());
      const DynamicMatrix H =
          told.basis.transpose() * information(result.shift, result.directions) * told.basis;
      const DynamicMatrix P = told.parts * prior_covariance * told.parts.transpose();
      const DynamicMatrix prior_information = inverted(P);
      const DynamicVector at = told.parts * result.shift;
      const DynamicVector gradient =
          prior_information * at + told.basis.transpose() * gradientOf(result.shift, result.directions);
      const Eigen::LDLT<DynamicMatrix> solver(prior_information + H);
      const DynamicVector step = solver.solve(-gradient);
      covariance =
          told.basis * solver.solve(DynamicMatrix::Identity(P.rows(), P.cols())) * told.basis.transpose();
      if (converged || !step.allFinite()) break;
      const Vector6d before = result.shift;
      result.shift = told.basis * (at + step);
      const Vector6d moved = result.shift - before;
      converged = moved.head<2>().norm() < kConverged_m && std::abs(moved(2)) < kConverged_rad;
    }
    conclude(prior_covariance, result);
    return result;
  }

 private:
  Eigen::Matrix2d rotation(const Vector6d& shift) const {
    return Eigen::Rotation2Dd(prior_.yaw_rad + shift(2)).toRotationMatrix();
  }

  void linearise(const Vector6d& shift, const PoseUncertainty& uncertain) {
    sweep_.undistort(scan_, prior_.correction + shift.tail<3>(), points_);
    const Eigen::Matrix2d R = rotation(shift);
    const Eigen::Vector2d p_odom = prior_.p_odom + shift.head<2>();
    equations_ = NormalEquations();
    equations_.squares.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector2d lever = R * points_[i];
      const double range_m = scan_.points[i].range_m;
      const double noise_m = params_.rangeSigma_m(range_m);
      const double pose_m2 = uncertain.position_m2 + uncertain.yaw_rad2 * range_m * range_m;
      const Eigen::Vector2d p_map = p_odom + lever;
      const MapLine* line = map_.lineAt(p_map, map_.levelFor(std::sqrt(noise_m * noise_m + pose_m2)));
      if (line == nullptr) continue;
      addPoint(i, *line, p_map, lever, R, noise_m, pose_m2);
    }
    equations_.information.told = equations_.M0;
    if (equations_.information.weight > 0.0)
      equations_.information.lever_m =
          std::max(0.1, std::sqrt(equations_.squared_levers / equations_.information.weight));
  }

  void addPoint(std::size_t i, const MapLine& line, const Eigen::Vector2d& p_map,
                const Eigen::Vector2d& lever, const Eigen::Matrix2d& R, double noise_m, double pose_m2) {
    const Eigen::Vector2d& n = line.normal;
    const Eigen::Vector2d offset = p_map - line.centre;
    const double residual_m = n.dot(offset);
    const double along_m = n.x() * offset.y() - n.y() * offset.x();
    const double facing = n.dot(R * scan_.points[i].direction_base);
    // Surfaces that are wider than the noise are no better known than that.
    const double surface_m2 =
        std::max(facing * facing * noise_m * noise_m + kRoughness_m * kRoughness_m, line.across_m2);
    const double variance_m2 =
        surface_m2 + line.centre_variance_m2 + line.normal_variance_rad2 * along_m * along_m;
    const double squared = residual_m * residual_m;
    const double loss = 1.0 / (1.0 + squared / (kLossSigmas * kLossSigmas * (variance_m2 + pose_m2)));
    const double w = loss * loss / variance_m2;
    const Eigen::Vector2d n_base = R.transpose() * n;
    const Eigen::Vector3d J(n_base.x(), n_base.y(), n.y() * lever.x() - n.x() * lever.y());
    const double t = scan_.points[i].after_s;
    const Eigen::Matrix3d JJ = w * J * J.transpose();
    equations_.M0 += JJ;
    equations_.g0 += w * residual_m * J;
    if (t > 0.0) {
      equations_.M1 += t * JJ;
      equations_.M2 += t * t * JJ;
      equations_.g1 += t * w * residual_m * J;
    }
    // What a wrong normal adds along the wall, where J would be (tangent, tangent x lever).
    const Eigen::Vector2d tangent_base(-n_base.y(), n_base.x());
    const Eigen::Vector3d F(tangent_base.x(), tangent_base.y(), n.dot(lever));
    equations_.information.feigned += w * line.normal_variance_rad2 * F * F.transpose();
    equations_.information.weight += w;
    equations_.squared_levers += w * lever.squaredNorm();
    equations_.keyframes += line.keyframes;
    equations_.squares.push_back(squared / variance_m2);
  }

  /// Columns of the Jacobian of d and c: the motion of the base is R^T d, and until a beam's time t it
  /// is t G c, of which no more is told than of d.
  Matrix6d information(const Vector6d& shift, const ToldDirections& directions) const {
    const Eigen::Matrix3d D = inBase(shift);
    const Eigen::Matrix3d C = directions.projection * Eigen::Matrix3d(gain_.asDiagonal());
    Matrix6d H;
    H.topLeftCorner<3, 3>() = D.transpose() * equations_.M0 * D;
    H.topRightCorner<3, 3>() = D.transpose() * equations_.M1 * C;
    H.bottomLeftCorner<3, 3>() = H.topRightCorner<3, 3>().transpose();
    H.bottomRightCorner<3, 3>() = C.transpose() * equations_.M2 * C;
    return H;
  }

  Vector6d gradientOf(const Vector6d& shift, const ToldDirections& directions) const {
    Vector6d gradient;
    gradient.head<3>() = inBase(shift).transpose() * equations_.g0;
    gradient.tail<3>() = gain_.asDiagonal() * (directions.projection.transpose() * equations_.g1);
    return gradient;
  }

  /// Zero along what is not told: there a scan moves no map.
  static Eigen::Matrix3d scanCovariance(const Eigen::Matrix3d& information,
                                        const Eigen::Matrix3d& R_base_odom,
                                        const ToldDirections& directions) {
    constexpr double kKnown = 1e9;
    const Eigen::Matrix3d untold = (Eigen::Matrix3d::Identity() - directions.projection) * R_base_odom;
    return Eigen::Matrix3d(information + 1e-3 * Eigen::Matrix3d::Identity() +
                           kKnown * untold.transpose() * untold)
        .inverse();
  }

  Eigen::Matrix3d inBase(const Vector6d& shift) const {
    Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
    result.topLeftCorner<2, 2>() = rotation(shift).transpose();
    return result;
  }

  void conclude(const Matrix6d& prior_covariance, Registration& result) {
    // Half of all normal errors lie within 0.6745 standard deviations.
    constexpr double kMedianSigmas = 0.6745;
    constexpr double kLeastScale = 0.3;
    constexpr double kMostScale = 1.5;  // of points that are counted as lying on the map
    std::vector<double>& squares = equations_.squares;
    if (!squares.empty())
      result.residual_scale = std::max(kLeastScale, std::sqrt(upperMedian(squares)) / kMedianSigmas);
    const double most = kLossSigmas * std::clamp(result.residual_scale, 1.0, kMostScale);
    const auto inliers =
        std::count_if(squares.begin(), squares.end(), [most](double square) { return square < most * most; });
    if (!points_.empty())
      result.inlier_share = static_cast<double>(inliers) / static_cast<double>(points_.size());
    if (!squares.empty())
      result.keyframes = std::max(1.0, equations_.keyframes / static_cast<double>(squares.size()));
    const double variance_scale = result.residual_scale * result.residual_scale;
    const Matrix6d H = information(result.shift, result.directions) / variance_scale;
    const Told told(result.directions, inBase(result.shift), sweep_.scaled());
    const DynamicMatrix P_told = told.parts * prior_covariance * told.parts.transpose();
    const DynamicMatrix after = inverted(inverted(P_told) + told.basis.transpose() * H * told.basis);
    const Matrix6d untold = Matrix6d::Identity() - told.basis * told.parts;
    result.contraction = untold + told.basis * (after * inverted(P_told)) * told.parts;
    const DynamicMatrix mixed = untold * prior_covariance * told.parts.transpose() * inverted(P_told) *
                                after * told.basis.transpose();
    result.covariance = untold * prior_covariance * untold.transpose() + mixed + mixed.transpose() +
                        told.basis * after * told.basis.transpose();
    result.scan_covariance = scanCovariance(H.topLeftCorner<3, 3>(), inBase(result.shift), result.directions);
    const Eigen::Matrix3d P =
        prior_covariance.topLeftCorner<3, 3>() + kLeastVariance * Eigen::Matrix3d::Identity();
    result.surprise = result.shift.head<3>().dot(P.ldlt().solve(result.shift.head<3>()));
  }

  const LaserPoints& scan_;
  const Sweep& sweep_;
  const LineMap& map_;
  const PlanarState& prior_;
  const LaserParams& params_;
  Eigen::Vector3d gain_;
  std::vector<Eigen::Vector2d> points_;  ///< undistorted, in the base
  NormalEquations equations_;
};

}  // namespace

Registration registerScan(const LaserPoints& scan, const Sweep& sweep, const LineMap& map,
                          const PlanarState& prior, const Matrix6d& prior_covariance,
                          const LaserParams& params, const std::optional<Eigen::Vector3d>& start) {
  return Registrar(scan, sweep, map, prior, params).run(prior_covariance, start);
}

}  // namespace stereo_nav::odometry
