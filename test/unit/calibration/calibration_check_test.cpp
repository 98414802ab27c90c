#include "stereo_nav/calibration/calibration_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/simulated_board.h"
#include "support/stereo_webcams.h"

namespace stereo_nav::calibration {
namespace {

/// A board seen by good cameras from a few places, and the cameras' true calibration.
class CalibrationCheckTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const test::WebcamPair cameras = test::webcamPair(320);
    const test::SimulatedBoard scene(cameras.left, cameras.right, Checkerboard{});
    std::uint64_t seed = 0;
    for (const auto& pose :
         {test::boardAt(-0.15, -0.12, 1.1, 20, 10, 0), test::boardAt(0.25, -0.12, 1.1, -20, 15, 3),
          test::boardAt(-0.15, 0.14, 1.1, 25, -20, -4), test::boardAt(0.25, 0.14, 1.1, -10, -25, 0),
          test::boardAt(0.03, 0.0, 0.8, 5, 5, 10)}) {
      ASSERT_TRUE(scene.inView(pose));
      const auto pair = scene.draw(pose, ++seed);
      const auto corners = findCorners(pair.left, pair.right, Checkerboard{});
      ASSERT_TRUE(corners);
      views().push_back(*corners);
    }
  }

  static std::vector<BoardCorners>& views() {
    static std::vector<BoardCorners> all;
    return all;
  }

  static StereoRig trueRig() {
    const test::WebcamPair cameras = test::webcamPair(320);
    return test::toRig(cameras.left, cameras.right);
  }

  static CalibrationCheck check(const StereoRig& rig, const Checkerboard& board = {},
                                const std::vector<BoardCorners>& seen = views()) {
    std::vector<ViewFigures> figures;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      figures.push_back(measureView(rig, board, "view " + std::to_string(i), seen[i]));
    }
    return checkCalibration(rig, figures, seen);
  }

  static std::vector<std::string> failures(const CalibrationCheck& check) {
    std::vector<std::string> names;
    for (const Criterion& criterion : check.criteria) {
      if (!criterion.met()) names.push_back(criterion.name);
    }
    return names;
  }
};

using Names = std::vector<std::string>;

TEST_F(CalibrationCheckTest, TheTrueCalibrationIsGood) {
  const CalibrationCheck result = check(trueRig());
  EXPECT_TRUE(result.good()) << failures(result).front();
  EXPECT_LT(result.left_lens_px, 0.1);
  EXPECT_LT(result.right_lens_px, 0.1);
  EXPECT_LT(result.reprojection_px, 0.12);
  EXPECT_LT(result.epipolar_rms_px, 0.12);
  EXPECT_LT(std::abs(result.scale_error), 0.003);
  EXPECT_TRUE(result.notes.empty()) << result.notes.front();
}

TEST_F(CalibrationCheckTest, DepthNoiseGrowsWithTheSquareOfTheDepth) {
  const StereoRig rig = trueRig();
  const CalibrationCheck result = check(rig);
  const double at_1m = result.depthNoise_m(rig.rectified, 1.0);
  EXPECT_NEAR(at_1m, result.disparity_rms_px / (rig.rectified.fx * rig.rectified.baseline_m), 1e-12);
  EXPECT_NEAR(result.depthNoise_m(rig.rectified, 10.0), 100.0 * at_1m, 1e-9);
}

TEST_F(CalibrationCheckTest, AWrongSquareIsAnErrorOfScaleAndNothingElse) {
  Checkerboard larger;
  larger.square_m *= 1.04;
  const CalibrationCheck result = check(trueRig(), larger);
  EXPECT_NEAR(result.scale_error, 1.0 / 1.04 - 1.0, 0.004);
  const Names failed = failures(result);
  EXPECT_NE(std::find(failed.begin(), failed.end(), "scale"), failed.end());
  EXPECT_EQ(std::count(failed.begin(), failed.end(), "lens, left"), 0);
  EXPECT_EQ(std::count(failed.begin(), failed.end(), "epipolar"), 0);
}

TEST_F(CalibrationCheckTest, ACameraThatWasKnockedShiftsTheRows) {
  StereoRig knocked = trueRig();
  const double tilt = 1.2 / knocked.right.K(1, 1);  // 1.2 px of rows
  knocked.right.R =
      cv::Matx33d(1, 0, 0, 0, std::cos(tilt), -std::sin(tilt), 0, std::sin(tilt), std::cos(tilt)) *
      knocked.right.R;
  const CalibrationCheck result = check(knocked);
  EXPECT_NEAR(std::abs(result.epipolar_mean_px), 1.2, 0.15);
  EXPECT_EQ(failures(result).back(), "epipolar");
  const auto epipolar = std::find_if(result.criteria.begin(), result.criteria.end(),
                                     [](const Criterion& one) { return one.name == "epipolar"; });
  EXPECT_NE(epipolar->remedy.find("have moved since"), std::string::npos) << epipolar->remedy;
  EXPECT_FALSE(result.good());
}

TEST_F(CalibrationCheckTest, AMovingBoardIsToldFromAKnockedCamera) {
  std::vector<BoardCorners> moving = views();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const float shift = i % 2 == 0 ? 1.5f : -1.5f;
    for (cv::Point2f& corner : moving[i].right) corner.y += shift;
  }
  const CalibrationCheck result = check(trueRig(), {}, moving);
  const auto epipolar = std::find_if(result.criteria.begin(), result.criteria.end(),
                                     [](const Criterion& one) { return one.name == "epipolar"; });
  EXPECT_FALSE(epipolar->met());
  EXPECT_EQ(epipolar->remedy.rfind("hold the board still", 0), 0u) << epipolar->remedy;
}

TEST_F(CalibrationCheckTest, AnotherLensIsPoor) {
  StereoRig other = trueRig();
  other.left.D.at<double>(0) += 0.8;
  const Names failed = failures(check(other));
  EXPECT_NE(std::find(failed.begin(), failed.end(), "lens, left"), failed.end());
  EXPECT_EQ(std::count(failed.begin(), failed.end(), "lens, right"), 0);
}

TEST_F(CalibrationCheckTest, FewViewsInOnePlaceAreNoted) {
  const CalibrationCheck result = check(trueRig(), {}, {views().front()});
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_NE(result.notes[0].find("only 1 view"), std::string::npos) << result.notes[0];
  EXPECT_NE(result.notes[1].find("% of the image only"), std::string::npos) << result.notes[1];
}

TEST_F(CalibrationCheckTest, ViewsThatCannotBeAreRefused) {
  BoardCorners swapped{views().front().right, views().front().left};
  EXPECT_THROW(measureView(trueRig(), {}, "a", swapped), std::runtime_error);
  BoardCorners incomplete = views().front();
  incomplete.right.pop_back();
  EXPECT_THROW(measureView(trueRig(), {}, "a", incomplete), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::calibration
