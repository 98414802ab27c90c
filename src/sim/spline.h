#pragma once

#include <Eigen/Core>
#include <vector>

namespace stereo_nav::sim {

/// A plane curve with continuous curvature through given points: cubic spline over the chord lengths, with a
/// given direction at its start and no curvature at its end. Asked by arc length.
class PlanarSpline {
 public:
  /// At least two points, no two neighbours closer than 1 mm; throws std::invalid_argument.
  PlanarSpline(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& start_direction);

  double length_m() const { return arc_m_.back(); }
  /// Arc length at which the curve passes points[index].
  double arcOfPoint(std::size_t index) const;

  struct Sample {
    Eigen::Vector2d position;
    double heading_rad;    ///< of the tangent, in (-pi, pi]
    double curvature_1pm;  ///< positive to the left
  };
  Sample at(double arc_m) const;

 private:
  struct Derivatives {
    Eigen::Vector2d value, first, second;
  };
  Derivatives evaluate(double parameter) const;
  double parameterOf(double arc_m) const;

  std::vector<double> knots_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Eigen::Vector2d> second_derivatives_;  ///< at the knots
  std::vector<double> parameter_, arc_m_;            ///< table of arc lengths
};

}  // namespace stereo_nav::sim
