#include "stereo_nav/calibration/board_pose.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

#include "core/angles.h"
#include "support/simulated_board.h"
#include "support/stereo_webcams.h"

namespace stereo_nav::calibration {
namespace {

struct RectifiedCorners {
  std::vector<Eigen::Vector2d> left, right;
};

RectifiedCorners project(const vision::StereoCalibration& calibration, const Checkerboard& board,
                         const Eigen::Isometry3d& T_camera_board) {
  RectifiedCorners corners;
  for (const Eigen::Vector3d& corner : board.corners()) {
    const Eigen::Vector3d pixels = calibration.project(T_camera_board * corner);
    corners.left.emplace_back(pixels.x(), pixels.y());
    corners.right.emplace_back(pixels.z(), pixels.y());
  }
  return corners;
}

class BoardPoseTest : public ::testing::Test {
 protected:
  const Checkerboard board_;
  const test::WebcamPair cameras_ = test::webcamPair(640);
  const StereoRig rig_ = test::toRig(cameras_.left, cameras_.right);
};

TEST_F(BoardPoseTest, ExactPixelsGiveTheExactPose) {
  const Eigen::Isometry3d truth = test::boardAt(0.1, -0.2, 0.8, 30, -20, 10);
  const auto corners = project(rig_.rectified, board_, truth);
  const auto pose = estimateBoardPose(rig_.rectified, board_, corners.left, corners.right);
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->T_camera_board.isApprox(truth, 1e-9));
  for (const Eigen::Vector4d& residual : pose->residual_px) EXPECT_LT(residual.norm(), 1e-6);
}

TEST_F(BoardPoseTest, TheCovarianceIsThatOfTheErrors) {
  const Eigen::Isometry3d truth = test::boardAt(0.0, 0.1, 1.0, -15, 25, 5);
  const auto exact = project(rig_.rectified, board_, truth);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.2);
  constexpr int kRuns = 300;
  double normalised = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    auto noisy = exact;
    for (auto* side : {&noisy.left, &noisy.right}) {
      for (Eigen::Vector2d& pixel : *side) pixel += Eigen::Vector2d(noise(random), noise(random));
    }
    const auto pose = estimateBoardPose(rig_.rectified, board_, noisy.left, noisy.right);
    ASSERT_TRUE(pose);
    const Vector6d error = logMotion(pose->T_camera_board * truth.inverse());
    normalised += error.dot(pose->covariance.inverse() * error) / kRuns;
  }
  EXPECT_NEAR(normalised, 6.0, 0.8);  // chi square of six degrees of freedom, mean of 300
}

TEST_F(BoardPoseTest, SwappedCamerasGiveNoPose) {
  const auto corners = project(rig_.rectified, board_, test::boardAt(0.0, 0.0, 0.8, 0, 0, 0));
  EXPECT_FALSE(estimateBoardPose(rig_.rectified, board_, corners.right, corners.left));
}

TEST_F(BoardPoseTest, AnglesAreThoseThatTheBoardWasTurnedBy) {
  for (const auto& [yaw, pitch, roll] : {std::array{0.0, 0.0, 0.0},
                                         {30.0, 0.0, 0.0},
                                         {0.0, -40.0, 0.0},
                                         {0.0, 0.0, 170.0},
                                         {-25.0, 35.0, -80.0}}) {
    const BoardAngles angles = boardAngles(test::boardAt(0, 0, 1, yaw, pitch, roll).linear());
    EXPECT_NEAR(angles.yaw_rad / kRadPerDeg, yaw, 1e-9);
    EXPECT_NEAR(angles.pitch_rad / kRadPerDeg, pitch, 1e-9);
    EXPECT_NEAR(angles.roll_rad / kRadPerDeg, roll, 1e-9);
  }
}

TEST_F(BoardPoseTest, YawBringsTheRightEdgeNearerAndPitchTheLowerEdgeFarther) {
  const auto depth = [this](const Eigen::Isometry3d& pose, std::size_t corner) {
    return (pose * board_.corners()[corner]).z();
  };
  const auto yawed = test::boardAt(0, 0, 1, 20, 0, 0), pitched = test::boardAt(0, 0, 1, 0, 20, 0);
  EXPECT_LT(depth(yawed, 7), depth(yawed, 0));       // first row, right and left
  EXPECT_GT(depth(pitched, 40), depth(pitched, 0));  // first column, lower and upper
}

TEST_F(BoardPoseTest, TheLensErrorIsThatOfTheLensAlone) {
  const test::SimulatedBoard scene(cameras_.left, cameras_.right, board_);
  const auto pair = scene.draw(test::boardAt(0.1, 0.05, 0.7, 25, 15, 0), 1);
  const auto corners = findCorners(pair.left, board_);
  ASSERT_TRUE(corners);
  EXPECT_LT(lensError_px(rig_.left, board_, *corners), 0.1);
  CameraModel without_distortion = rig_.left;
  without_distortion.D = cv::Mat::zeros(1, 5, CV_64FC1);
  EXPECT_GT(lensError_px(without_distortion, board_, *corners), 0.5);
}

TEST_F(BoardPoseTest, AnglesOfViewAreThoseOfTheRays) {
  CameraModel ideal = rig_.left;
  ideal.D = cv::Mat::zeros(1, 5, CV_64FC1);
  ideal.K = cv::Matx33d(320, 0, 319.5, 0, 240, 239.5, 0, 0, 1);
  EXPECT_NEAR(ideal.horizontalView_rad() / kRadPerDeg, 90.0, 1e-3);
  EXPECT_NEAR(ideal.verticalView_rad() / kRadPerDeg, 90.0, 1e-3);
  EXPECT_NEAR(rectifiedView_rad(320.0, 319.5, 640) / kRadPerDeg, 90.0, 1e-9);
}

TEST_F(BoardPoseTest, AnEquidistantLensIsJudgedAsOne) {
  CameraModel lens = rig_.left;
  lens.equidistant = true;
  lens.D = (cv::Mat_<double>(1, 4) << 0.02, -0.01, 0.005, 0.0);
  std::vector<cv::Point3d> board;
  for (const Eigen::Vector3d& corner : board_.corners()) board.emplace_back(corner.x(), corner.y(), 0.0);
  const cv::Vec3d rotation(0.2, -0.3, 0.1), translation(-0.1, -0.05, 0.4);
  std::vector<cv::Point2d> raw, rectified;
  cv::fisheye::projectPoints(board, raw, rotation, translation, lens.K, lens.D);
  const std::vector<cv::Point2f> seen(raw.begin(), raw.end());
  EXPECT_LT(lensError_px(lens, board_, seen), 1e-3);
  EXPECT_GT(lensError_px(rig_.left, board_, seen), 0.3) << "it is none of plumb_bob";

  lens.R = cv::Matx33d::eye();
  cv::projectPoints(board, rotation, translation, lens.P.get_minor<3, 3>(0, 0), cv::noArray(), rectified);
  const auto pixels = lens.rectify(seen);
  ASSERT_EQ(pixels.size(), rectified.size());
  EXPECT_NEAR(pixels[0].x(), rectified[0].x, 1e-3);
  EXPECT_NEAR(pixels[0].y(), rectified[0].y, 1e-3);

  lens.D = cv::Mat::zeros(1, 4, CV_64FC1);
  lens.size = {640, 480};
  lens.K = cv::Matx33d(320, 0, 319.5, 0, 240, 239.5, 0, 0, 1);
  EXPECT_NEAR(lens.horizontalView_rad(), 2.0, 1e-6) << "the angle grows with the radius";
}

}  // namespace
}  // namespace stereo_nav::calibration
