#include "stereo_nav/vision/stereo_calibration.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "support/textured_room.h"

namespace stereo_nav::vision {
namespace {

TEST(StereoCalibration, ProjectionAndBackProjectionAreInverse) {
  StereoCalibration calibration = test::roomCalibration();
  calibration.right_cx = 150.0;  // principal points may differ
  const Eigen::Vector3d p_camera(0.4, -0.3, 2.5);
  const Eigen::Vector3d pixels = calibration.project(p_camera);
  const double disparity_px = (pixels.x() - calibration.cx) - (pixels.z() - calibration.right_cx);
  EXPECT_NEAR(disparity_px, 280.0 * 0.12 / 2.5, 1e-12);
  EXPECT_TRUE(calibration.backProject(pixels.x(), pixels.y(), disparity_px).isApprox(p_camera, 1e-12));
}

TEST(StereoCalibration, SaysWhichValueIsImpossible) {
  StereoCalibration calibration = test::roomCalibration();
  EXPECT_NO_THROW(calibration.validate());
  calibration.baseline_m = 0.0;
  try {
    calibration.validate();
    FAIL() << "a pair without baseline was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("baseline [m] is 0"), std::string::npos) << error.what();
  }
  calibration = test::roomCalibration();
  calibration.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(calibration.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::vision
