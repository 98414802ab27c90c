#include "odometry/stereo/window_optimizer.h"

#include <gtest/gtest.h>

#include "support/textured_room.h"
#include "synthetic_map.h"

namespace stereo_nav::odometry {
namespace {

/// Five frames along a curve that see 80 points; poses and landmarks start wrong.
class WindowOptimizerTest : public ::testing::Test {
 protected:
  void build(double offset_s) {
    Vector6d twist;
    twist << 0.1, 0.02, -0.4, 0.02, 0.1, 0.01;
    for (int f = 0; f < 5; ++f) {
      WindowFrame frame;
      frame.view.T_camera_world = expMotion(twist * f);
      frame.view.T_late_camera = expMotion(twist * offset_s);
      truth.push_back(frame.view);
      if (offset_s != 0.0) {
        frame.has_time_offset = true;
        frame.late_sigma.setConstant(0.005);
        frame.T_late_expected = frame.view.T_late_camera;
        frame.view.T_late_camera = expMotion(0.7 * twist * offset_s);
      }
      Vector6d error = Vector6d::Constant(0.01);
      if (f > 0) frame.view.T_camera_world = expMotion(error) * frame.view.T_camera_world;
      window.push_back(frame);
    }
    for (const Eigen::Vector3d& p : test::pointsAhead(80, 11)) {
      Landmark landmark;
      landmark.ray_depth = {p.x() / p.z(), p.y() / p.z(), 1.15 / p.z()};
      for (int f = 0; f < 5; ++f) {
        landmark.views.push_back(
            {f, test::observe(calibration, truth[static_cast<std::size_t>(f)], p, 0.0, random)});
      }
      landmarks.push_back(landmark);
      points.push_back(p);
    }
  }

  double worstPoint() const {
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      worst = std::max(worst, (landmarks[i].p_world() - points[i]).norm());
    }
    return worst;
  }

  vision::StereoCalibration calibration = test::roomCalibration();
  std::vector<vision::StereoView> truth;
  std::vector<WindowFrame> window;
  std::vector<Landmark> landmarks;
  std::vector<Eigen::Vector3d> points;
  std::mt19937 random{7};
};

TEST_F(WindowOptimizerTest, FindsPosesAndLandmarksOfASynchronousWindow) {
  build(0.0);
  WindowOptimizerParams params;
  params.iterations = 15;
  WindowOptimizer optimizer(params, calibration);
  ASSERT_TRUE(optimizer.optimise(window, landmarks));
  for (std::size_t f = 0; f < window.size(); ++f) {
    EXPECT_LT(logMotion(window[f].view.T_camera_world * truth[f].T_camera_world.inverse()).norm(), 1e-4);
  }
  EXPECT_LT(worstPoint(), 1e-3);
}

TEST_F(WindowOptimizerTest, FindsTheMotionBetweenDifferentStampsToo) {
  build(0.5);
  WindowOptimizerParams params;
  params.iterations = 30;
  WindowOptimizer optimizer(params, calibration);
  ASSERT_TRUE(optimizer.optimise(window, landmarks));
  for (std::size_t f = 0; f < window.size(); ++f) {
    EXPECT_LT(logMotion(window[f].view.T_camera_world * truth[f].T_camera_world.inverse()).norm(), 0.02);
    EXPECT_LT(logMotion(window[f].view.T_late_camera * truth[f].T_late_camera.inverse()).norm(), 0.02);
  }
}

TEST_F(WindowOptimizerTest, TheFirstFrameIsHeld) {
  build(0.0);
  const Eigen::Matrix4d before = window.front().view.T_camera_world.matrix();
  WindowOptimizer optimizer(WindowOptimizerParams(), calibration);
  ASSERT_TRUE(optimizer.optimise(window, landmarks));
  EXPECT_EQ(window.front().view.T_camera_world.matrix(), before);
}

TEST_F(WindowOptimizerTest, HasNothingToDoForOneFrameOrNoLandmarks) {
  build(0.0);
  WindowOptimizer optimizer(WindowOptimizerParams(), calibration);
  std::vector<Landmark> none;
  EXPECT_FALSE(optimizer.optimise(window, none));
  window.resize(1);
  EXPECT_FALSE(optimizer.optimise(window, landmarks));
}

}  // namespace
}  // namespace stereo_nav::odometry
