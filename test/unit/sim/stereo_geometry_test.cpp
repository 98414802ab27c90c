#include <gtest/gtest.h>

#include <algorithm>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

/// |disparity - analytic| for all pixels of a wall in the middle of the view, by semi-global matching of the images
/// rectified by OpenCV.
std::vector<double> disparityErrors(double distance_m) {
  Scenario scenario = cleanScenario();
  ObjectParams wall = wallAhead(distance_m, TextureKind::kClutter);
  wall.material.texel_mm = distance_m;
  scenario.scene.objects = {wall};
  scenario.rig.samples_per_pixel = 8;
  const Simulation simulation(scenario, thesisRig(), 1);
  const CameraCalibration &left = simulation.calibration(Side::kLeft), &right = simulation.calibration(Side::kRight);
  cv::Mat fixed_point;
  cv::StereoSGBM::create(0, 64, 9, 200, 800)->compute(rectify(left, simulation.image(Side::kLeft, 0)),
                                                      rectify(right, simulation.image(Side::kRight, 0)), fixed_point);
  const double analytic = -right.P(0, 3) / distance_m;
  std::vector<double> errors;
  const int floor_row = static_cast<int>(left.P(1, 2) + left.P(1, 1) * scenario.rig.camera_z_m / distance_m);
  for (int y = 40; y < std::min(floor_row - 10, 200); ++y) {
    for (int x = 110; x < 280; ++x) {
      const short value = fixed_point.at<short>(y, x);
      if (value > 0) errors.push_back(std::fabs(value / 16.0 - analytic));
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(StereoGeometry, DisparityOfAWallIsTheAnalyticOne) {
  for (const double distance_m : {1.5, 3.0, 6.0}) {
    const std::vector<double> errors = disparityErrors(distance_m);
    ASSERT_GT(errors.size(), 10000u) << distance_m;
    EXPECT_LT(errors[errors.size() / 2], 0.1) << distance_m << " m, median";
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.25) << distance_m << " m, 95 %";
  }
}

TEST(StereoGeometry, SkewShiftsTheRightImageByTheMotionInBetween) {
  Scenario scenario = cleanScenario();
  PathStep turn;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 30.0;
  scenario.path = {turn};
  scenario.motion.max_yaw_rate_dps = 40.0;
  scenario.timing.skew_ms = 10.0;
  scenario.scene.objects = {wallAhead(3.0, TextureKind::kClutter)};
  const Simulation simulation(scenario, thesisRig(), 1);
  const PairInstants& pair = simulation.pairs()[10];
  EXPECT_NEAR(pair.right_s - pair.left_s, 0.010, 1e-12);
  EXPECT_EQ(simulation.imageTime(Side::kRight, 10), pair.right_s);
  const Eigen::Isometry3d at_left = simulation.cameraPose(Side::kRight, pair.left_s);
  const Eigen::Isometry3d at_right = simulation.cameraPose(Side::kRight, pair.right_s);
  EXPECT_GT(Eigen::AngleAxisd(at_left.linear().transpose() * at_right.linear()).angle(), 1e-3);
}

}  // namespace
}  // namespace stereo_nav::sim
