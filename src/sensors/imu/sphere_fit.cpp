#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <sstream>

#include "core/gauss_newton.h"
#include "stereo_nav/core/lie.h"
#include "stereo_nav/sensors/imu/calibration.h"

namespace stereo_nav::imu {
namespace {

using Eigen::Vector3d;

constexpr double kMinReach = 0.7;
constexpr double kMaxResidual = 0.05;
constexpr int kIterations = 20;

Vector3d corrected(const Vector3d& point, const SphereFit& fit) {
  return (point - fit.offset).cwiseProduct(fit.scale);
}

/// a x^2 + b y^2 + c z^2 + d x + e y + f z = 1; false when the points do not form an ellipsoid.
bool fitAlgebraically(const std::vector<Vector3d>& points, double radius, SphereFit& fit) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(points.size()), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d p = points[i] / radius;
    A.row(static_cast<Eigen::Index>(i)) << p.cwiseAbs2().transpose(), p.transpose();
  }
  const Vector6d solution = A.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(A.rows()));
  const Vector3d quadratic = solution.head<3>();
  const Vector3d linear = solution.tail<3>();
  if (!(quadratic.minCoeff() > 0.0)) return false;
  const Vector3d centre = -0.5 * linear.cwiseQuotient(quadratic);
  const double level = 1.0 + centre.cwiseAbs2().dot(quadratic);
  fit.offset = centre * radius;
  fit.scale = (quadratic / level).cwiseSqrt();
  return true;
}

/// Gauss-Newton on |corrected| - radius.
void refine(const std::vector<Vector3d>& points, double radius, SphereFit& fit) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
    Vector6d g = Vector6d::Zero();
    for (const Vector3d& point : points) {
      const Vector3d q = corrected(point, fit);
      const Vector3d direction = q.normalized();
      Vector6d J;
      J << -direction.cwiseProduct(fit.scale), direction.cwiseProduct(point - fit.offset);
      H += J * J.transpose();
      g += J * (q.norm() - radius);
    }
    const auto delta = gaussNewtonStep(H, g);
    if (!delta) return;
    fit.offset += delta->head<3>();
    fit.scale += delta->tail<3>();
    if (delta->norm() < 1e-12 * radius) return;
  }
}

}  // namespace

SphereFit fitSphere(const std::vector<Vector3d>& points, double radius) {
  SphereFit fit;
  std::ostringstream text;
  if (points.size() < 20 || !fitAlgebraically(points, radius, fit)) {
    fit.message = "the measurements do not cover the sphere: turn the module slowly about each of its axes";
    return fit;
  }
  refine(points, radius, fit);
  Vector3d lowest = Vector3d::Constant(radius);
  Vector3d highest = -lowest;
  double squares = 0.0;
  for (const Vector3d& point : points) {
    const Vector3d q = corrected(point, fit);
    lowest = lowest.cwiseMin(q);
    highest = highest.cwiseMax(q);
    squares += std::pow(q.norm() - radius, 2);
  }
  fit.residual_rms = std::sqrt(squares / static_cast<double>(points.size()));
  for (int axis = 0; axis < 3; ++axis) {
    if (lowest[axis] > -kMinReach * radius || highest[axis] < kMinReach * radius) {
      text << "axis "
           << "xyz"[axis] << " was not turned both up and down (reached " << lowest[axis] / radius << " to "
           << highest[axis] / radius << " of the full value, needed -0.7 to 0.7): turn further";
      fit.message = text.str();
      return fit;
    }
  }
  if (!(fit.residual_rms <= kMaxResidual * radius)) {
    text << "the magnitude still varies by " << fit.residual_rms / radius * 100.0
         << " % (allowed 5 %): turn more slowly, without jerks";
    fit.message = text.str();
    return fit;
  }
  fit.accepted = true;
  text << "offset " << fit.offset.transpose() << ", scale " << fit.scale.transpose() << ", remaining RMS "
       << fit.residual_rms;
  fit.message = text.str();
  return fit;
}

}  // namespace stereo_nav::imu
