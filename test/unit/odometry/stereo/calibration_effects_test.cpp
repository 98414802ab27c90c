#include "odometry/stereo/calibration_effects.h"

#include <gtest/gtest.h>

#include "support/textured_room.h"
#include "synthetic_map.h"

namespace stereo_nav::odometry {
namespace {

TEST(LensErrorFields, HaveAnRmsOfOnePixelAndNeitherShiftNorScale) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  const LensErrorFields fields(calibration);
  double squares_px2 = 0.0;
  int pixels = 0;
  LensErrorFields::Shifts sum = LensErrorFields::Shifts::Zero(), along = LensErrorFields::Shifts::Zero();
  for (int row = 0; row < calibration.height; ++row) {
    for (int column = 0; column < calibration.width; ++column, ++pixels) {
      const Eigen::Vector2d ray((column - calibration.cx) / calibration.fx,
                                (row - calibration.cy) / calibration.fy);
      const LensErrorFields::Shifts shifts = fields.at(ray);
      squares_px2 += shifts.squaredNorm();
      sum += shifts;
      along += ray.asDiagonal() * shifts;
    }
  }
  EXPECT_NEAR(std::sqrt(squares_px2 / pixels), 1.0, 0.02);
  EXPECT_LT((sum / pixels).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((along / pixels).cwiseAbs().maxCoeff(), 0.01);
}

/// A drive past 100 points, seen by cameras that are not as calibrated: `unit` selects the error.
class CalibrationEffectsTest : public ::testing::TestWithParam<int> {
 protected:
  CalibrationEffectsTest() {
    Vector6d twist;
    twist << 0.05, -0.02, -0.3, 0.02, 0.05, -0.02;
    view.T_camera_world = expMotion(twist);  // the world is the previous camera
  }

  /// Pixels of a point where the error is kError_px units large.
  vision::StereoObservation seen(const Eigen::Vector3d& p_camera) const {
    const Eigen::Vector3d px = calibration.project(p_camera);
    vision::StereoObservation observation;
    observation.left_px = px.head<2>();
    observation.right_px << px.z(), px.y();
    observation.has_right = true;
    const LensErrorFields fields(calibration);
    const Eigen::Vector2d left = p_camera.head<2>() / p_camera.z();
    const Eigen::Vector2d right = left - Eigen::Vector2d(calibration.baseline_m / p_camera.z(), 0.0);
    const int error = GetParam();
    if (error == 0) observation.right_px.x() += kError_px;
    if (error >= 1 && error <= 3) observation.left_px += kError_px * fields.at(left).col(error - 1);
    if (error >= 4) observation.right_px += kError_px * fields.at(right).col(error - 4);
    return observation;
  }

  Eigen::Vector3d triangulated(const vision::StereoObservation& observation) const {
    const double disparity_px =
        observation.left_px.x() - calibration.cx - (observation.right_px.x() - calibration.right_cx);
    const double row = 0.5 * (observation.left_px.y() + observation.right_px.y());
    return calibration.backProject(observation.left_px.x(), row, disparity_px);
  }

  static constexpr double kError_px = 0.01;
  vision::StereoCalibration calibration = test::roomCalibration();
  vision::StereoView view;
  PoseEstimatorParams params;
};

TEST_P(CalibrationEffectsTest, AreWhatTheEstimationMakesOfThem) {
  std::vector<MapObservation> observations;
  std::vector<Track> tracks;
  for (const Eigen::Vector3d& p : test::pointsAhead(100, 3)) {
    observations.push_back({triangulated(seen(p)), seen(view.T_camera_world * p)});
    Track track;
    track.p_world = p;
    track.at_stamp = seen(view.T_camera_world * p);
    track.inlier = true;
    tracks.push_back(track);
  }
  MotionPrior prior;
  prior.interval_s = 0.1;
  const PoseEstimate estimate = PoseEstimator(params, calibration).estimate(observations, prior, view);
  ASSERT_TRUE(estimate.converged);
  const Vector6d error = logMotion(view.T_camera_world * estimate.view.T_camera_world.inverse());
  const CalibrationEffects effects = CalibrationEffectsModel(params.loss_px, calibration)
                                         .of(tracks, estimate, view.T_camera_world.inverse());
  const Vector6d predicted = kError_px * effects.col(GetParam());
  EXPECT_LT((error - predicted).norm(), 0.1 * error.norm()) << error.transpose() << "\n"
                                                            << predicted.transpose();
  EXPECT_GT(error.norm(), 1e-6) << "the error has an effect";
}

INSTANTIATE_TEST_SUITE_P(UnitErrors, CalibrationEffectsTest, testing::Range(0, 7));

}  // namespace
}  // namespace stereo_nav::odometry
