#pragma once

#include <Eigen/Core>
#include <vector>

namespace stereo_nav::grid {

/// A convex polygon, its corners counterclockwise.
using Polygon = std::vector<Eigen::Vector2d>;

/// The smallest convex polygon that holds all points; collinear ones are left out.
Polygon convexHull(Polygon points);

/// The outline of the robot on the floor, in base_link (x forward, y left), in m. A concave outline counts as
/// its convex hull, since what is swept by a motion fills dents anyway.
class Footprint {
 public:
  /// Throws InputError for less than three corners, for corners on one line or not finite, and where
  /// base_link's origin is outside: the robot turns about it.
  explicit Footprint(const Polygon& corners_m);
  /// A rectangle about the origin.
  static Footprint rectangle(double length_m, double width_m);

  const Polygon& corners() const { return corners_; }
  /// From the origin to the nearest side and to the farthest corner, m.
  double inscribedRadius() const { return inscribed_m_; }
  double circumscribedRadius() const { return circumscribed_m_; }

  /// The corners of the robot at a pose.
  Polygon at(const Eigen::Vector2d& position, double heading_rad) const;
  /// What the robot touches on a straight way with one heading.
  Polygon sweptBy(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double heading_rad) const;
  /// What the robot touches while it turns in place, the shorter way round; convex, hence a little more than
  /// that.
  Polygon turning(const Eigen::Vector2d& position, double from_rad, double to_rad) const;

 private:
  Polygon corners_;
  double inscribed_m_ = 0.0, circumscribed_m_ = 0.0;
};

}  // namespace stereo_nav::grid
