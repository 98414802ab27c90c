#include "vision/epipolar_error.h"

#include <gtest/gtest.h>

#include <random>

#include "support/textured_room.h"

namespace stereo_nav::vision {
namespace {

class EpipolarErrorTest : public ::testing::Test {
 protected:
  /// Where the right camera shows what belongs at `right_px`: it is turned by `roll_rad` about its axis, has
  /// a focal length `zoom` times the left one's, and shows everything 1.5 px too low.
  Eigen::Vector2d disturbed(const Eigen::Vector2d& right_px) const {
    const Eigen::Vector2d centre(calibration.right_cx, calibration.cy);
    return centre + kZoom * (Eigen::Rotation2Dd(kRoll_rad) * (right_px - centre)) +
           Eigen::Vector2d(0.0, kNod_px);
  }

  /// Matches all over the image; the share `outliers` of them are at arbitrary places.
  void teach(EpipolarError& error, int matches, double outliers) {
    std::uniform_real_distribution<double> x(0.0, calibration.width);
    std::uniform_real_distribution<double> y(0.0, calibration.height);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::uniform_real_distribution<double> anything(-5.0, 5.0);
    std::normal_distribution<double> noise(0.0, 0.2);
    for (int i = 0; i < matches; ++i) {
      const Eigen::Vector2d ideal(x(random), y(random));
      const Eigen::Vector2d seen = disturbed(ideal);
      const double row_error = share(random) < outliers ? anything(random) : seen.y() - ideal.y();
      error.add(seen, row_error + noise(random));
      if (i % 100 == 99) error.learn();
    }
    error.learn();
  }

  static constexpr double kRoll_rad = 0.005;
  static constexpr double kZoom = 1.003;
  static constexpr double kNod_px = 1.5;
  StereoCalibration calibration = test::roomCalibration();
  std::mt19937 random{3};
};

TEST_F(EpipolarErrorTest, KnowsNothingAtFirstAndSaysSo) {
  const EpipolarError error(EpipolarErrorParams(), calibration);
  EXPECT_EQ(error.at({100.0, 50.0}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(error.slack_px(), 6.0, 1e-9);  // 3 sigma of 2 px
}

TEST_F(EpipolarErrorTest, LearnsNodRollAndFocalLengthDespiteOutliers) {
  EpipolarError error(EpipolarErrorParams(), calibration);
  teach(error, 2000, 0.1);
  EXPECT_LT(error.slack_px(), 0.1);
  for (const Eigen::Vector2d& ideal :
       {Eigen::Vector2d(20.0, 20.0), Eigen::Vector2d(160.0, 200.0), Eigen::Vector2d(300.0, 120.0)}) {
    const Eigen::Vector2d seen = disturbed(ideal);
    const Eigen::Vector2d corrected = seen - error.at(seen);
    EXPECT_NEAR(corrected.y(), ideal.y(), 0.05) << ideal.transpose();
    // The effect of the pitch on the columns is below a tenth of that here.
    EXPECT_NEAR(corrected.x(), ideal.x(), 0.3) << ideal.transpose();
  }
}

TEST_F(EpipolarErrorTest, FollowsACameraThatWasKnocked) {
  EpipolarErrorParams params;
  params.memory = 500.0;
  EpipolarError error(params, calibration);
  for (int i = 0; i < 2000; ++i) {
    error.add({160.0, 120.0}, 0.5);
    if (i % 100 == 99) error.learn();
  }
  for (int i = 0; i < 20000; ++i) {
    error.add({160.0, 120.0}, -0.5);
    if (i % 100 == 99) error.learn();
  }
  EXPECT_NEAR(error.at({160.0, 120.0}).y(), -0.5, 0.05);
}

}  // namespace
}  // namespace stereo_nav::vision
