#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/video.hpp>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

/// Errors of the disparities of corners on a wall ahead, sorted by size. Corners are followed from the left
/// to the right image, both rectified by OpenCV, by Lucas-Kanade: block matching would lock to whole pixels
/// by up to 0.2 px.
std::vector<double> disparityErrors(double distance_m) {
  Scenario scenario = cleanScenario();
  ObjectParams wall = wallAhead(distance_m, TextureKind::kClutter);
  wall.material.texel_mm = 0.4 * distance_m;
  scenario.scene.objects = {wall};
  scenario.rig.samples_per_pixel = 16;
  const Simulation simulation(scenario, thesisRig(), 1);
  const CameraCalibration &left = simulation.calibration(Side::kLeft),
                          &right = simulation.calibration(Side::kRight);
  const cv::Mat left_image = rectify(left, simulation.image(Side::kLeft, 0));
  const cv::Mat right_image = rectify(right, simulation.image(Side::kRight, 0));
  const double analytic = -right.P(0, 3) / distance_m;
  const int floor_row = static_cast<int>(left.P(1, 2) + left.P(1, 1) * scenario.rig.camera.z_m / distance_m);

  cv::Mat inside = cv::Mat::zeros(left_image.size(), CV_8UC1);
  inside(cv::Rect(70, 20, 230, std::min(floor_row, 230) - 35)) = 255;
  std::vector<cv::Point2f> corners, matches;
  cv::goodFeaturesToTrack(left_image, corners, 200, 0.02, 6.0, inside);
  for (const cv::Point2f& corner : corners)
    matches.emplace_back(corner.x - static_cast<float>(analytic) + 0.6f, corner.y);
  std::vector<uchar> found;
  std::vector<float> residuals;
  cv::calcOpticalFlowPyrLK(left_image, right_image, corners, matches, found, residuals, {15, 15}, 0,
                           {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 1e-4},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<double> errors;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (found[i])
      errors.push_back(std::hypot(corners[i].x - matches[i].x - analytic, corners[i].y - matches[i].y));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(StereoGeometry, DisparityOfAWallIsTheAnalyticOne) {
  for (const double distance_m : {1.5, 3.0, 6.0}) {
    const std::vector<double> errors = disparityErrors(distance_m);
    ASSERT_GE(errors.size(), 50u) << distance_m;
    EXPECT_LT(errors[errors.size() / 2], 0.08) << distance_m << " m, median";
    EXPECT_LT(errors[errors.size() * 98 / 100], 0.25) << distance_m << " m, 98 %";
  }
}

TEST(StereoGeometry, SkewShiftsTheRightImageByTheMotionInBetween) {
  Scenario scenario = cleanScenario();
  PathStep turn;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 30.0;
  scenario.path = {turn};
  scenario.motion.max_yaw_rate_dps = 40.0;
  scenario.timing.time_offset_ms = 10.0;
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
