#include "sim/trajectory.h"

#include <gtest/gtest.h>

#include "sim/spline.h"
#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

Scenario arena() {
  return loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml");
}

TEST(PlanarSpline, AStraightLineIsExact) {
  const PlanarSpline line({{0, 0}, {1, 0}, {3, 0}}, {1, 0});
  EXPECT_NEAR(line.length_m(), 3.0, 1e-9);
  EXPECT_NEAR(line.at(2.2).position.x(), 2.2, 1e-9);
  EXPECT_NEAR(line.at(2.2).curvature_1pm, 0.0, 1e-12);
  EXPECT_NEAR(line.arcOfPoint(1), 1.0, 1e-9);
}

TEST(PlanarSpline, PassesItsPointsWithContinuousCurvature) {
  const std::vector<Eigen::Vector2d> points{{0, 0}, {1, 0.2}, {1.5, 1.0}, {1.0, 2.0}};
  const PlanarSpline curve(points, {1, 0});
  EXPECT_NEAR(curve.at(0.0).heading_rad, 0.0, 1e-9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((curve.at(curve.arcOfPoint(i)).position - points[i]).norm(), 1e-6);
  }
  const double knot = curve.arcOfPoint(1), step = 1e-5;
  EXPECT_NEAR(curve.at(knot - step).curvature_1pm, curve.at(knot + step).curvature_1pm, 1e-3);
  EXPECT_LT((curve.at(1.0 + step).position - curve.at(1.0).position).norm() / step - 1.0, 1e-6);
  EXPECT_THROW(PlanarSpline({{0, 0}, {0, 0}}, {1, 0}), std::invalid_argument);
}

TEST(Trajectory, VisitsTheWaypointsOfTheThesis) {
  const Scenario scenario = arena();
  const Trajectory trajectory(scenario.path, scenario.motion);
  ASSERT_EQ(trajectory.waypoints().size(), 12u);
  double before = 0.0;
  for (const WaypointPassing& passing : trajectory.waypoints()) {
    EXPECT_GT(passing.time_s, before);
    EXPECT_LT((trajectory.pose(passing.time_s).translation().head<2>() - passing.position).norm(), 2e-3);
    before = passing.time_s;
  }
  EXPECT_LT((trajectory.waypoints().back().position - Eigen::Vector2d(8, -3)).norm(), 1e-12);
}

TEST(Trajectory, IsNonHolonomicSmoothAndWithinItsLimits) {
  const Scenario scenario = arena();
  const Trajectory trajectory(scenario.path, scenario.motion);
  Eigen::Vector3d last_rate = Eigen::Vector3d::Zero(), last_velocity = Eigen::Vector3d::Zero();
  for (double time_s = 0.01; time_s < trajectory.duration_s(); time_s += 0.01) {
    const BaseState state = trajectory.state(time_s);
    // Sway tilts base_link by a few mrad, so that a trace of the speed shows on z.
    EXPECT_NEAR(state.velocity_base.y(), 0.0, 1e-4) << time_s;
    EXPECT_GE(state.velocity_base.x(), -1e-6) << time_s;
    EXPECT_LT(state.velocity_base.x(),
              scenario.motion.max_speed_mps * (1.0 + scenario.motion.speed_variation) + 1e-6);
    EXPECT_LT(std::fabs(state.angular_velocity_base.z()),
              1.25 * scenario.motion.max_yaw_rate_dps * M_PI / 180.0);
    EXPECT_LT((state.velocity_base - last_velocity).norm(), 0.01) << time_s;
    EXPECT_LT((state.angular_velocity_base - last_rate).norm(), 0.05) << time_s;
    last_rate = state.angular_velocity_base;
    last_velocity = state.velocity_base;
  }
}

TEST(Trajectory, TurnsOnTheSpotAndStandsBeforeAndAfter) {
  PathStep wait, turn;
  wait.action = PathStep::Action::kWait;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 720.0;
  const Trajectory trajectory({wait, turn, wait}, MotionParams());
  const double end_s = trajectory.duration_s();
  EXPECT_NEAR(end_s, 1.0 + 2.0 * 720.0 / 45.0 + 1.0, 1e-9);
  for (const double time_s : {-1.0, 0.5, end_s, end_s + 5.0}) {
    EXPECT_TRUE(trajectory.pose(time_s).isApprox(Eigen::Isometry3d::Identity(), 1e-9)) << time_s;
  }
  EXPECT_LT(trajectory.state(0.5 * end_s).velocity_base.norm(), 1e-9);
  EXPECT_NEAR(trajectory.state(0.5 * end_s).angular_velocity_base.z(), 45.0 * M_PI / 180.0, 1e-3);
}

}  // namespace
}  // namespace stereo_nav::sim
