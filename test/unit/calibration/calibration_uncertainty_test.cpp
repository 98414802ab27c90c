#include "calibration/calibration_uncertainty.h"

#include <gtest/gtest.h>

#include <random>

#include "support/simulated_board.h"

namespace stereo_nav::calibration {
namespace {

constexpr float kNoise_px = 0.1f;

/// Cameras of 640x480 without distortion, 0.12 m apart: raw images are rectified ones.
StereoRig straightRig() {
  StereoRig rig;
  vision::StereoCalibration& c = rig.rectified;
  c.width = 640, c.height = 480;
  c.fx = c.fy = 600.0;
  c.cx = c.right_cx = 320.0, c.cy = 240.0;
  c.baseline_m = 0.12;
  for (CameraModel* camera : {&rig.left, &rig.right}) {
    camera->size = {640, 480};
    camera->K = cv::Matx33d(600, 0, 320, 0, 600, 240, 0, 0, 1);
    camera->D = cv::Mat::zeros(1, 5, CV_64FC1);
    camera->R = cv::Matx33d::eye();
    camera->P = cv::Matx34d(600, 0, 320, 0, 0, 600, 240, 0, 0, 0, 1, 0);
  }
  rig.right.P(0, 3) = -600.0 * 0.12;
  return rig;
}

/// What cameras of this rectified calibration see of a board: corners with noise.
BoardCorners seenBy(const vision::StereoCalibration& truth, const Eigen::Isometry3d& T_camera_board,
                    std::mt19937& random) {
  std::normal_distribution<float> noise(0.0f, kNoise_px);
  BoardCorners corners;
  for (const Eigen::Vector3d& corner : Checkerboard{}.corners()) {
    const Eigen::Vector3d p = T_camera_board * corner;
    const double y = truth.fy * p.y() / p.z() + truth.cy;
    const double left = truth.fx * p.x() / p.z() + truth.cx;
    const double right = truth.fx * (p.x() - truth.baseline_m) / p.z() + truth.right_cx;
    corners.left.emplace_back(static_cast<float>(left) + noise(random),
                              static_cast<float>(y) + noise(random));
    corners.right.emplace_back(static_cast<float>(right) + noise(random),
                               static_cast<float>(y) + noise(random));
  }
  return corners;
}

/// `bend` moves the corners of a view after they are seen.
template <class Bend>
CalibrationUncertainty uncertaintyOf(const StereoRig& rig, const vision::StereoCalibration& truth,
                                     const std::vector<Eigen::Isometry3d>& poses, Bend bend) {
  std::mt19937 random(1);
  std::vector<ViewFigures> views;
  for (const Eigen::Isometry3d& pose : poses) {
    BoardCorners corners = seenBy(truth, pose, random);
    bend(corners);
    views.push_back(measureView(rig, {}, "view", corners));
  }
  return calibrationUncertainty(rig, {}, views);
}

void leaveAsTheyAre(BoardCorners&) {}

/// All over the image, 0.6 to 2 m away, tilted.
std::vector<Eigen::Isometry3d> manyPoses() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 40; ++i) {
    const double z_m = 0.6 + 1.4 * i / 39.0;
    poses.push_back(test::boardAt(0.25 * z_m * share(random) + 0.06, 0.2 * z_m * share(random), z_m,
                                  35 * share(random), 35 * share(random), 20 * share(random)));
  }
  return poses;
}

TEST(CalibrationUncertainty, AnExactCalibrationIsOffByNoMoreThanTheNoise) {
  const StereoRig rig = straightRig();
  const CalibrationUncertainty found = uncertaintyOf(rig, rig.rectified, manyPoses(), leaveAsTheyAre);
  ASSERT_TRUE(found.baseline_share && found.column_offset_px && found.focal_share && found.distortion_px);
  EXPECT_LT(*found.baseline_share, 0.001);
  EXPECT_LT(*found.column_offset_px, 0.06);
  EXPECT_LT(*found.focal_share, 0.001);
  EXPECT_LT(*found.distortion_px, 0.02);
}

TEST(CalibrationUncertainty, EachErrorOfACalibrationIsFound) {
  const StereoRig rig = straightRig();
  vision::StereoCalibration truth = rig.rectified;
  truth.baseline_m *= 1.005;
  EXPECT_NEAR(uncertaintyOf(rig, truth, manyPoses(), leaveAsTheyAre).baseline_share.value(), 0.005, 0.0007);
  truth = rig.rectified;
  truth.right_cx += 0.4;
  EXPECT_NEAR(uncertaintyOf(rig, truth, manyPoses(), leaveAsTheyAre).column_offset_px.value(), 0.4, 0.05);
  truth = rig.rectified;
  truth.fx *= 1.004, truth.fy *= 1.004;
  EXPECT_NEAR(uncertaintyOf(rig, truth, manyPoses(), leaveAsTheyAre).focal_share.value(), 0.004, 0.0007);
}

TEST(CalibrationUncertainty, ALensThatIsBentMoreThanItsModelIsFound) {
  const StereoRig rig = straightRig();
  const auto barrel = [](BoardCorners& corners) {
    for (cv::Point2f& corner : corners.left) {
      const cv::Point2f ray = (corner - cv::Point2f(320, 240)) / 600.0f;
      corner += 600.0f * 0.004f * ray.dot(ray) * ray;  // 0.5 px in the corners
    }
  };
  const CalibrationUncertainty found = uncertaintyOf(rig, rig.rectified, manyPoses(), barrel);
  ASSERT_TRUE(found.distortion_px);
  EXPECT_GT(*found.distortion_px, 0.02);
  EXPECT_LT(*found.distortion_px, 0.1);
}

TEST(CalibrationUncertainty, ViewsInOnePlaceTellNothing) {
  const StereoRig rig = straightRig();
  const std::vector<Eigen::Isometry3d> same(20, test::boardAt(0.06, 0.0, 1.5, 0, 0, 0));
  const CalibrationUncertainty found = uncertaintyOf(rig, rig.rectified, same, leaveAsTheyAre);
  EXPECT_FALSE(found.baseline_share);
  EXPECT_FALSE(found.focal_share);
  EXPECT_FALSE(uncertaintyOf(rig, rig.rectified, {same[0], same[1]}, leaveAsTheyAre).distortion_px);
}

}  // namespace
}  // namespace stereo_nav::calibration
