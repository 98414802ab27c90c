#include "navigation/control/drive_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angles.h"

namespace stereo_nav::control {
namespace {

TEST(DriveModel, TheVelocityFollowsWithTheLag) {
  DriveModelParams params;
  params.max_acceleration_m_per_s2 = 100.0;
  const DriveState state = advanced(params, {}, {1.0, 0.0, 0.0}, params.lag_s);
  EXPECT_NEAR(state.twist.x(), 1.0 - std::exp(-1.0), 0.02);
  const double way_m = params.lag_s * std::exp(-1.0);
  EXPECT_NEAR(state.T_world_base.translation().x(), way_m, 0.1 * way_m);
}

TEST(DriveModel, TheChangeOfVelocityIsLimitedAsAVector) {
  const DriveModelParams params;
  const DriveState state = advanced(params, {}, {3.0, 4.0, 100.0}, 0.1);
  EXPECT_NEAR(state.twist.x(), 0.6 * 0.3, 1e-9);
  EXPECT_NEAR(state.twist.y(), 0.8 * 0.3, 1e-9);
  EXPECT_NEAR(state.twist.z(), 1.2, 1e-9);
}

TEST(DriveModel, ASteeredVehicleDrivesTheCircleOfItsSteeringAngle) {
  DriveModelParams params;
  params.wheelbase_m = 0.5;
  DriveState state;
  state.twist = steeredTwist(1.0, std::atan(0.5), 0.5);  // a radius of 1 m
  state.steering_rad = std::atan(0.5);
  EXPECT_NEAR(state.twist.z(), 1.0, 1e-12);
  const DriveState half = advanced(params, state, state.twist, kPi);
  EXPECT_LT((half.T_world_base.translation() - Eigen::Vector2d(0.0, 2.0)).norm(), 1e-6);
}

TEST(DriveModel, SteeringIsNoFasterThanItsRate) {
  DriveModelParams params;
  params.wheelbase_m = 0.5;
  DriveState state;
  state.twist.x() = 1.0;
  const DriveState after = advanced(params, state, steeredTwist(1.0, 1.2, 0.5), 0.1);
  EXPECT_NEAR(after.steering_rad, 0.3, 1e-9);
  const DriveState held = advanced(params, after, Twist::Zero(), 0.1);  // says nothing of the steering
  EXPECT_NEAR(held.steering_rad, 0.3, 1e-9);
}

TEST(CommandHistory, ACommandActsAfterTheDeadTime) {
  const DriveModelParams params;
  CommandHistory history(params);
  history.add(10.0, {1.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(history.predicted({}, 10.0, 10.04).twist.x(), 0.0);
  EXPECT_GT(history.predicted({}, 10.0, 10.06).twist.x(), 0.05);
}

TEST(CommandHistory, ThePredictionIsTheDriveItself) {
  DriveModelParams params;
  CommandHistory history(params);
  DriveState state;
  for (int i = 0; i < 20; ++i) {
    const double time_s = 0.02 * i;
    history.add(time_s, {1.0, 0.2, std::sin(time_s)});
    state = history.predicted(state, time_s, time_s + 0.02);
  }
  const DriveState at_once = history.predicted({}, 0.0, 0.4);
  EXPECT_LT((at_once.T_world_base.matrix() - state.T_world_base.matrix()).norm(), 1e-9);
  EXPECT_LT((at_once.twist - state.twist).norm(), 1e-9);
}

TEST(CommandHistory, AnOlderStateIsBroughtForward) {
  CommandHistory history{DriveModelParams()};
  history.add(0.0, {1.0, 0.0, 0.0});
  DriveState state;
  state.twist.x() = 1.0;
  const DriveState now = history.predicted(state, 1.0, 1.3);
  EXPECT_NEAR(now.T_world_base.translation().x(), 0.3, 1e-9);
  EXPECT_NEAR(history.predicted(state, 1.0, 0.9).T_world_base.translation().x(), 0.0, 1e-12);
}

}  // namespace
}  // namespace stereo_nav::control
