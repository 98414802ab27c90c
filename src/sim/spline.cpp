#include "sim/spline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stereo_nav::sim {
namespace {

/// Second derivatives at the knots of the C2 spline: first derivative given at the start, second derivative
/// zero at the end. Thomas' algorithm on the tridiagonal system.
std::vector<Eigen::Vector2d> solveSecondDerivatives(const std::vector<double>& knots,
                                                    const std::vector<Eigen::Vector2d>& points,
                                                    const Eigen::Vector2d& start_slope) {
  const std::size_t n = points.size();
  std::vector<double> upper(n, 0.0);
  std::vector<Eigen::Vector2d> right(n, Eigen::Vector2d::Zero());
  const auto slope = [&](std::size_t i) {
    return Eigen::Vector2d((points[i + 1] - points[i]) / (knots[i + 1] - knots[i]));
  };
  const double h0 = knots[1] - knots[0];
  upper[0] = 0.5;
  right[0] = 3.0 / h0 * (slope(0) - start_slope);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = knots[i] - knots[i - 1], after = knots[i + 1] - knots[i];
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    right[i] = (6.0 * (slope(i) - slope(i - 1)) - before * right[i - 1]) / pivot;
  }
  std::vector<Eigen::Vector2d> result(n, Eigen::Vector2d::Zero());
  for (std::size_t i = n - 1; i-- > 0;) result[i] = right[i] - upper[i] * result[i + 1];
  return result;
}

/// Cubic Hermite interpolation on [0, h].
double hermite(double x, double h, double y0, double slope0, double y1, double slope1) {
  const double t = x / h, u = 1.0 - t;
  return u * u * ((1.0 + 2.0 * t) * y0 + t * h * slope0) + t * t * ((3.0 - 2.0 * t) * y1 - u * h * slope1);
}

}  // namespace

PlanarSpline::PlanarSpline(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& start_direction)
    : points_(points) {
  if (points.size() < 2) throw std::invalid_argument("spline: two points are the least");
  knots_.push_back(0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = (points[i] - points[i - 1]).norm();
    if (!(chord > 1e-3)) throw std::invalid_argument("spline: two neighbouring points are the same");
    knots_.push_back(knots_.back() + chord);
  }
  second_derivatives_ = solveSecondDerivatives(knots_, points_, start_direction.normalized());

  constexpr double kStep = 0.005;
  const auto steps = static_cast<std::size_t>(std::ceil(knots_.back() / kStep));
  double arc = 0.0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double parameter = knots_.back() * static_cast<double>(i) / static_cast<double>(steps);
    if (i > 0) {  // Simpson's rule
      const double from = parameter_.back();
      arc += (parameter - from) / 6.0 *
             (evaluate(from).first.norm() + 4.0 * evaluate(0.5 * (from + parameter)).first.norm() +
              evaluate(parameter).first.norm());
    }
    parameter_.push_back(parameter);
    arc_m_.push_back(arc);
  }
}

PlanarSpline::Derivatives PlanarSpline::evaluate(double parameter) const {
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, parameter);
  const auto i = static_cast<std::size_t>(after - knots_.begin()) - 1;
  const double h = knots_[i + 1] - knots_[i], a = (knots_[i + 1] - parameter) / h, b = 1.0 - a;
  const Eigen::Vector2d &m0 = second_derivatives_[i], &m1 = second_derivatives_[i + 1];
  Derivatives d;
  d.value = a * points_[i] + b * points_[i + 1] + h * h / 6.0 * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
  d.first =
      (points_[i + 1] - points_[i]) / h + h / 6.0 * ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0);
  d.second = a * m0 + b * m1;
  return d;
}

double PlanarSpline::parameterOf(double arc_m) const {
  const auto after = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, arc_m);
  const auto i = static_cast<std::size_t>(after - arc_m_.begin()) - 1;
  const double h = arc_m_[i + 1] - arc_m_[i];
  return hermite(std::clamp(arc_m - arc_m_[i], 0.0, h), h, parameter_[i],
                 1.0 / evaluate(parameter_[i]).first.norm(), parameter_[i + 1],
                 1.0 / evaluate(parameter_[i + 1]).first.norm());
}

double PlanarSpline::arcOfPoint(std::size_t index) const {
  const auto after = std::upper_bound(parameter_.begin() + 1, parameter_.end() - 1, knots_[index]);
  const auto i = static_cast<std::size_t>(after - parameter_.begin()) - 1;
  const double h = parameter_[i + 1] - parameter_[i];
  return hermite(knots_[index] - parameter_[i], h, arc_m_[i], evaluate(parameter_[i]).first.norm(),
                 arc_m_[i + 1], evaluate(parameter_[i + 1]).first.norm());
}

PlanarSpline::Sample PlanarSpline::at(double arc_m) const {
  const Derivatives d = evaluate(parameterOf(arc_m));
  const double cross = d.first.x() * d.second.y() - d.first.y() * d.second.x();
  return {d.value, std::atan2(d.first.y(), d.first.x()), cross / std::pow(d.first.norm(), 3.0)};
}

}  // namespace stereo_nav::sim
