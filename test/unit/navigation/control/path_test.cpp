#include "navigation/control/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::control {
namespace {

std::vector<Eigen::Vector2d> circle(double radius_m, double turn_rad) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 400; ++i) {
    const double angle = turn_rad * i / 400;
    points.emplace_back(radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)));
  }
  return points;
}

TEST(Path, ACircleToTheLeftHasItsCurvature) {
  const Path path(circle(2.0, kPi));
  EXPECT_NEAR(path.length_m(), 2.0 * kPi, 1e-3);
  const PathPoint middle = path.at(kPi);
  EXPECT_NEAR(middle.curvature_per_m, 0.5, 0.005);
  EXPECT_NEAR(middle.heading_rad, 0.5 * kPi, 1e-3);
  EXPECT_LT((middle.position - Eigen::Vector2d(2.0, 2.0)).norm(), 1e-3);
}

TEST(Path, HeadingsCountOnBeyondAFullTurn) {
  const Path path(circle(1.0, 4.0 * kPi));
  EXPECT_NEAR(path.points().back().heading_rad, 4.0 * kPi, 0.02);
}

TEST(Path, ACornerIsTurnedByItsWholeAngle) {
  const Path path({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}});
  EXPECT_DOUBLE_EQ(path.length_m(), 2.0);
  EXPECT_NEAR(path.at(0.8).heading_rad, 0.0, 1e-9);
  EXPECT_NEAR(path.at(1.2).heading_rad, 0.5 * kPi, 1e-9);
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < path.points().size(); ++i) {
    const PathPoint &a = path.points()[i - 1], &b = path.points()[i];
    turned_rad += 0.5 * (a.curvature_per_m + b.curvature_per_m) * (b.arc_m - a.arc_m);
  }
  EXPECT_NEAR(turned_rad, 0.5 * kPi, 0.02);
}

TEST(Path, TheNearestPlaceIsSoughtInItsWindowAlone) {
  const Path path({{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.5}, {0.0, 0.5}});  // there and back
  EXPECT_NEAR(path.nearestArc({1.0, 0.4}, 0.0, path.length_m()), 3.5, 1e-9);
  EXPECT_NEAR(path.nearestArc({1.0, 0.4}, 0.0, 1.5), 1.0, 1e-9);
  EXPECT_NEAR(path.leftOf({1.0, 0.4}, 1.0), 0.4, 1e-9);
  EXPECT_NEAR(path.leftOf({1.0, 0.4}, 3.5), 0.1, 1e-9);
}

TEST(Path, APathWithoutLengthIsRefused) {
  EXPECT_THROW(Path({{1.0, 1.0}, {1.0, 1.0}}), InputError);
  EXPECT_THROW(Path({{1.0, 1.0}, {std::nan(""), 1.0}}), InputError);
}

}  // namespace
}  // namespace stereo_nav::control
