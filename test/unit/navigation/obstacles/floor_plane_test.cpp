#include "navigation/obstacles/floor_plane.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "unit/navigation/obstacles/drawn_disparity.h"

namespace stereo_nav::navigation {
namespace {

cv::Mat floorSeenBy(const DisparityCamera& camera, double sigma_px) {
  return drawDisparity(camera, sigma_px, 1, [](const auto& origin, const auto& direction) {
    return planeAt(0.0, origin, direction);
  });
}

TEST(FloorPlane, OfTheMountingIsWhatTheCameraSees) {
  for (const double pitch_deg : {0.0, 10.0, 25.0}) {
    const DisparityCamera camera = drawnCamera(pitch_deg * kRadPerDeg);
    const FloorPlane floor = floorOf(camera);
    const cv::Mat_<float> seen = floorSeenBy(camera, 0.0);
    for (int v = 0; v < 240; v += 7)
      for (int u = 0; u < 320; u += 11)
        EXPECT_NEAR(seen(v, u) > 0.0F ? floor.disparity(u, v) - double{seen(v, u)} : 0.0, 0.0, 1e-3);
  }
}

TEST(FloorPlane, IsFoundWhereTheMountingIsALittleWrong) {
  const DisparityCamera believed = drawnCamera(0.0);
  for (const double error_deg : {-1.5, 1.0}) {
    const DisparityCamera camera = drawnCamera(error_deg * kRadPerDeg);
    const FloorPlane floor =
        estimatedFloor(floorSeenBy(camera, 0.3), believed, floorOf(believed), 2.0 * kRadPerDeg);
    const FloorPlane truth = floorOf(camera);
    for (const double v : {160.0, 200.0, 235.0})
      EXPECT_NEAR(floor.disparity(160.0, v), truth.disparity(160.0, v), 0.15) << error_deg;
    EXPECT_NEAR(floor.height_m, 0.28, 0.01);
  }
}

TEST(FloorPlane, StaysAsExpectedWhereNoFloorIsSeenOrItIsTiltedTooMuch) {
  const DisparityCamera believed = drawnCamera(0.0);
  const FloorPlane expected = floorOf(believed);
  const cv::Mat nothing(240, 320, CV_32FC1, cv::Scalar(-1.0));
  EXPECT_EQ(estimatedFloor(nothing, believed, expected, 0.03).coefficients, expected.coefficients);
  const cv::Mat tilted = floorSeenBy(drawnCamera(3.0 * kRadPerDeg), 0.3);
  EXPECT_EQ(estimatedFloor(tilted, believed, expected, 1.0 * kRadPerDeg).coefficients, expected.coefficients);
}

}  // namespace
}  // namespace stereo_nav::navigation
