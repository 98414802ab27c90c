#include "sensors/serial/lower_hull.h"

#include <algorithm>

namespace stereo_nav::serial {
namespace {

/// Positive when c lies to the left of the line from a to b.
double turn(const LowerHull::Point& a, const LowerHull::Point& b, const LowerHull::Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

void LowerHull::add(double x, double y) {
  const Point point{x, y};
  while (points_.size() >= 2 && turn(points_[points_.size() - 2], points_.back(), point) <= 0.0) {
    points_.pop_back();
  }
  points_.push_back(point);
}

double LowerHull::middleSlope() const {
  const double middle = 0.5 * (points_.front().x + points_.back().x);
  const auto right = std::upper_bound(points_.begin() + 1, points_.end() - 1, middle,
                                      [](double x, const Point& point) { return x < point.x; });
  const auto left = right - 1;
  return (right->y - left->y) / (right->x - left->x);
}

double LowerHull::offset(double slope) const {
  double lowest = points_.front().y - slope * points_.front().x;
  for (const Point& point : points_) lowest = std::min(lowest, point.y - slope * point.x);
  return lowest;
}

}  // namespace stereo_nav::serial
