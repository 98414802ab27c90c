#include "sim/calibration_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim_test_support.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::sim {
namespace {

constexpr int kSeeds = 400;

CalibrationErrorParams noErrors() {
  CalibrationErrorParams params;
  params.scale = 2.0;
  params.baseline_share = params.column_offset_px = params.focal_share = 0.0;
  params.distortion_px = params.mounting_rad = 0.0;
  return params;
}

/// RMS over the seeds of what `measure` says of the cameras drawn.
template <class Measure>
double rmsOverSeeds(const CalibrationErrorParams& params, Measure measure) {
  const StereoCalibrationPair nominal = thesisRig();
  double sum = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double value = measure(nominal, trueCameras(params, nominal, static_cast<std::uint64_t>(seed)));
    sum += value * value;
  }
  return std::sqrt(sum / kSeeds);
}

/// Pixels by which two cameras see the same ray apart, RMS over the image.
double apart_px(const CameraCalibration& one, const CameraCalibration& other) {
  double sum = 0.0;
  int count = 0;
  for (int y = 10; y < one.height; y += 20) {
    for (int x = 10; x < one.width; x += 20, ++count)
      sum += (other.distort(one.undistort({x, y})) - Eigen::Vector2d(x, y)).squaredNorm();
  }
  return std::sqrt(sum / count);
}

TEST(CalibrationError, CamerasAreAsCalibratedUnlessAskedFor) {
  const StereoCalibrationPair nominal = thesisRig();
  const TrueCameras cameras = trueCameras({}, nominal, 1);
  EXPECT_EQ(apart_px(nominal.right, cameras.calibration.right), apart_px(nominal.right, nominal.right));
  EXPECT_EQ(cameras.calibration.right.P, nominal.right.P);
  EXPECT_EQ(cameras.T_nominal_true.matrix(), Eigen::Matrix4d::Identity());
}

TEST(CalibrationError, DrawsHaveTheStandardDeviationsAskedFor) {
  CalibrationErrorParams params = noErrors();
  params.baseline_share = 0.001;
  EXPECT_NEAR(rmsOverSeeds(params,
                           [](const auto& nominal, const TrueCameras& cameras) {
                             return cameras.calibration.right.offsetX_m() / nominal.right.offsetX_m() - 1.0;
                           }),
              0.002, 0.0002);
  params = noErrors();
  params.column_offset_px = 0.1;
  EXPECT_NEAR(
      rmsOverSeeds(
          params,
          [](const auto& nominal, const TrueCameras& cameras) {
            return cameras.calibration.right.distort({0.1, 0.1}).x() - nominal.right.distort({0.1, 0.1}).x();
          }),
      0.2, 0.02);
  params = noErrors();
  params.focal_share = 0.001;
  EXPECT_NEAR(rmsOverSeeds(params,
                           [](const auto& nominal, const TrueCameras& cameras) {
                             return cameras.calibration.left.K(1, 1) / nominal.left.K(1, 1) - 1.0;
                           }),
              0.002, 0.0002);
  params = noErrors();
  params.distortion_px = 0.2;
  EXPECT_NEAR(rmsOverSeeds(params,
                           [](const auto& nominal, const TrueCameras& cameras) {
                             return apart_px(nominal.left, cameras.calibration.left);
                           }),
              0.4, 0.05);
  params = noErrors();
  params.mounting_rad = 0.003;
  EXPECT_NEAR(rmsOverSeeds(params,
                           [](const auto&, const TrueCameras& cameras) {
                             return logRotation(Eigen::Matrix3d(cameras.T_nominal_true.linear())).norm();
                           }),
              0.006 * std::sqrt(3.0), 0.0006);
}

TEST(CalibrationError, ImagesAreThoseOfTheTrueCamerasAndTheCalibrationIsTheNominalOne) {
  Scenario scenario = cleanScenario();
  scenario.scene.objects = {wallAhead(2.0, TextureKind::kClutter)};
  const Simulation exact(scenario, thesisRig(), 1);
  scenario.calibration_error = noErrors();
  scenario.calibration_error.column_offset_px = 20.0;
  const Simulation off(scenario, thesisRig(), 1);
  EXPECT_EQ(off.calibration(Side::kRight).K, thesisRig().right.K);
  const cv::Mat left_before = exact.image(Side::kLeft, 0), left_after = off.image(Side::kLeft, 0);
  EXPECT_EQ(cv::norm(left_before, left_after, cv::NORM_INF), 0.0);
  const double shift_px = trueCameras(scenario.calibration_error, thesisRig(), 1).calibration.right.K(0, 2) -
                          thesisRig().right.K(0, 2);
  ASSERT_GT(std::abs(shift_px), 2.0);
  // The principal point moves the image as a whole.
  const cv::Mat before = exact.image(Side::kRight, 0), after = off.image(Side::kRight, 0);
  const cv::Matx23d move(1, 0, shift_px, 0, 1, 0);
  cv::Mat moved;
  cv::warpAffine(before, moved, move, before.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  const int margin = static_cast<int>(std::abs(shift_px)) + 2;
  const cv::Rect inside(margin, 60, before.cols - 2 * margin, 100);
  EXPECT_LT(cv::norm(moved(inside), after(inside), cv::NORM_L1),
            0.3 * cv::norm(before(inside), after(inside), cv::NORM_L1));
}

TEST(CalibrationError, AMountingThatIsOffTurnsTheCamerasAboutTheLeftOne) {
  Scenario scenario = cleanScenario();
  const Simulation exact(scenario, thesisRig(), 3);
  scenario.calibration_error = noErrors();
  scenario.calibration_error.mounting_rad = 0.05;
  const Simulation off(scenario, thesisRig(), 3);
  const Eigen::Isometry3d T_nominal_true =
      trueCameras(scenario.calibration_error, thesisRig(), 3).T_nominal_true;
  EXPECT_LT(
      (off.cameraPose(Side::kLeft, 0.0).translation() - exact.cameraPose(Side::kLeft, 0.0).translation())
          .norm(),
      1e-9);
  const Eigen::Isometry3d T_base_camera = scenario.rig.T_base_camera();
  const Eigen::Isometry3d T_world_base = exact.trajectory().pose(0.0);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Isometry3d T_camera_raw =
        (T_world_base * T_base_camera).inverse() * exact.cameraPose(side, 0.0);
    const Eigen::Isometry3d expected = T_world_base * T_base_camera * T_nominal_true * T_camera_raw;
    EXPECT_TRUE(off.cameraPose(side, 0.0).isApprox(expected, 1e-12));
  }
}

}  // namespace
}  // namespace stereo_nav::sim
