#pragma once

#include <cstddef>
#include <vector>

namespace stereo_nav::serial {

/// Lower convex hull of points that come with growing x (Andrew's monotone chain); O(1) amortised per point.
class LowerHull {
 public:
  struct Point {
    double x;
    double y;
  };

  /// `x` must be larger than every x before.
  void add(double x, double y);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }
  /// Distance in x from the first point to the last; 0 when empty.
  double span() const { return points_.empty() ? 0.0 : points_.back().x - points_.front().x; }
  std::size_t size() const { return points_.size(); }

  /// Slope of the edge over the middle of the span. Of all lines below the points it is the one nearest to
  /// them on average. Needs two points.
  double middleSlope() const;
  /// The largest b for which the line slope * x + b lies above no point. Needs a point.
  double offset(double slope) const;

 private:
  std::vector<Point> points_;
};

}  // namespace stereo_nav::serial
