#include "core/local_tangent_plane.h"

#include <gtest/gtest.h>

namespace stereo_nav {
namespace {

TEST(LocalTangentPlane, HasTheLengthsOfDegreesOfWgs84) {
  // A degree at 45 degrees north: 111131.8 m along the meridian, 78846.8 m across (tables of WGS 84).
  const Eigen::Vector3d origin(45.0, 10.0, 0.0);
  EXPECT_NEAR(eastNorthUp_m(origin, {45.01, 10.0, 0.0}).y(), 1111.32, 0.05);
  EXPECT_NEAR(eastNorthUp_m(origin, {45.0, 10.01, 0.0}).x(), 788.47, 0.05);
  EXPECT_NEAR(eastNorthUp_m(origin, {45.0, 10.0, 12.5}).z(), 12.5, 1e-12);
}

TEST(LocalTangentPlane, CrossesTheDateLine) {
  EXPECT_NEAR(eastNorthUp_m({0.0, 179.9999, 0.0}, {0.0, -179.9999, 0.0}).x(), 22.26, 0.01);
}

}  // namespace
}  // namespace stereo_nav
