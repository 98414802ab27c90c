#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace stereo_nav::control {

/// A place on a path.
struct PathPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double arc_m = 0.0;            ///< length of the path up to here
  double heading_rad = 0.0;      ///< of the tangent; continuous along the path, not wrapped
  double curvature_per_m = 0.0;  ///< positive to the left
};

/// A polyline with arc length, heading and curvature. Heading is the direction of the chord over 5 cm to
/// either side, curvature the change of heading over the same: so points that are rounded to millimetres give
/// no noise, and a corner is turned over some decimetres instead of on the spot.
class Path {
 public:
  /// Repeated points are left out; segments are divided into pieces of 2 cm at most. Throws InputError where
  /// fewer than two points are left, or one is not finite.
  explicit Path(const std::vector<Eigen::Vector2d>& points);

  double length_m() const { return points_.back().arc_m; }
  const std::vector<PathPoint>& points() const { return points_; }

  /// The place at an arc length, which is held within the path.
  PathPoint at(double arc_m) const;

  /// Arc length of the place nearest to `position` among those from `from_m` to `to_m`.
  double nearestArc(const Eigen::Vector2d& position, double from_m, double to_m) const;

  /// Distance of `position` from the path at `arc_m`, along the normal: positive to its left.
  double leftOf(const Eigen::Vector2d& position, double arc_m) const;

 private:
  std::size_t segmentAt(double arc_m) const;
  Eigen::Vector2d positionAt(double arc_m) const;
  void addHeadings();
  void addCurvatures();

  std::vector<PathPoint> points_;
};

}  // namespace stereo_nav::control
