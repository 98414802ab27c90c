#include "stereo_nav/calibration/checkerboard.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "support/simulated_board.h"
#include "support/stereo_webcams.h"

namespace stereo_nav::calibration {
namespace {

std::vector<cv::Point2f> trueCorners(const sim::CameraCalibration& camera, const Checkerboard& board,
                                     const Eigen::Isometry3d& T_camera_board) {
  std::vector<cv::Point2f> pixels;
  for (const Eigen::Vector3d& corner : board.corners()) {
    const Eigen::Vector3d p =
        camera.R.transpose() * (T_camera_board * corner - Eigen::Vector3d(camera.offsetX_m(), 0.0, 0.0));
    const Eigen::Vector2d pixel = camera.distort(p.hnormalized());
    pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  return pixels;
}

double rmsDistance(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  return cv::norm(a, b) / std::sqrt(static_cast<double>(a.size()));
}

class CheckerboardTest : public ::testing::TestWithParam<int> {
 protected:
  const Checkerboard board_;
  const test::WebcamPair cameras_ = test::webcamPair(GetParam());
  const test::SimulatedBoard scene_{cameras_.left, cameras_.right, board_};
};

TEST_P(CheckerboardTest, CornersOfARawPictureAreFound) {
  for (const Eigen::Isometry3d& pose :
       {test::boardAt(0.0, 0.0, 0.7, 0, 0, 0), test::boardAt(0.05, -0.05, 0.9, 35, -10, 8),
        test::boardAt(-0.1, 0.1, 1.5, -20, 30, -15)}) {
    ASSERT_TRUE(scene_.inView(pose));
    const auto pair = scene_.draw(pose, 1);
    const auto corners = findCorners(pair.left, pair.right, board_);
    ASSERT_TRUE(corners);
    EXPECT_LT(rmsDistance(corners->left, trueCorners(cameras_.left, board_, pose)), 0.15);
    EXPECT_LT(rmsDistance(corners->right, trueCorners(cameras_.right, board_, pose)), 0.15);
  }
}

TEST_P(CheckerboardTest, BothImagesHaveOneOrderWhateverTheRoll) {
  for (const double roll_deg : {45.0, 88.0, 90.5, -89.7, -60.0}) {
    const Eigen::Isometry3d pose = test::boardAt(0.0, 0.0, 1.0, 5, 5, roll_deg);
    ASSERT_TRUE(scene_.inView(pose));
    const auto pair = scene_.draw(pose, 1);
    const auto corners = findCorners(pair.left, pair.right, board_);
    ASSERT_TRUE(corners) << roll_deg;
    // A board of even sizes looks the same after half a turn.
    const auto half_turned = pose * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
    const double as_drawn_px = rmsDistance(corners->left, trueCorners(cameras_.left, board_, pose));
    const auto& order = as_drawn_px < 1.0 ? pose : half_turned;
    EXPECT_LT(rmsDistance(corners->left, trueCorners(cameras_.left, board_, order)), 0.15) << roll_deg;
    EXPECT_LT(rmsDistance(corners->right, trueCorners(cameras_.right, board_, order)), 0.15) << roll_deg;
  }
}

TEST_P(CheckerboardTest, ABoardThatIsPartlyOutOfViewIsNotFoundAmiss) {
  const auto view = test::boardAt(0.0, 0.0, 0.8, -15, 10, 3);
  int cut_off = 0;
  for (int step = 0; step < 12; ++step) {
    Eigen::Isometry3d pose = view;
    pose.translation().x() = (step % 2 == 0 ? 1.0 : -1.0) * (0.26 + 0.025 * (step / 2));
    const auto pair = scene_.draw(pose, 1);
    const auto corners = findCorners(pair.left, board_);
    if (!corners) {
      ++cut_off;
      continue;
    }
    EXPECT_LT(rmsDistance(*corners, trueCorners(cameras_.left, board_, pose)), 0.3) << step;
  }
  EXPECT_GT(cut_off, 4);
}

TEST_P(CheckerboardTest, WhereThereIsNoneNoneIsFound) {
  EXPECT_FALSE(findCorners(cv::Mat(240, 320, CV_8UC1, cv::Scalar(128)), board_));
}

INSTANTIATE_TEST_SUITE_P(Widths, CheckerboardTest, ::testing::Values(320, 640));

TEST(Checkerboard, CornersAreCentredAndRowByRow) {
  const Checkerboard board{4, 3, 0.1};
  const auto corners = board.corners();
  ASSERT_EQ(corners.size(), 12u);
  EXPECT_TRUE(corners.front().isApprox(Eigen::Vector3d(-0.15, -0.1, 0.0)));
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector3d(-0.05, -0.1, 0.0)));
  EXPECT_TRUE(corners.back().isApprox(Eigen::Vector3d(0.15, 0.1, 0.0)));
}

TEST(Checkerboard, ImpossibleInputIsRefused) {
  const cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(128)), colour(240, 320, CV_8UC3, cv::Scalar::all(128));
  EXPECT_THROW(findCorners(grey, Checkerboard{2, 6, 0.05}), std::invalid_argument);
  EXPECT_THROW(findCorners(colour, Checkerboard{}), std::invalid_argument);
  EXPECT_THROW(findCorners(cv::Mat(), Checkerboard{}), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::calibration
