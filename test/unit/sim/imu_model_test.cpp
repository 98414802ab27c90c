#include "sim/imu_model.h"

#include <gtest/gtest.h>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

Trajectory drive(const char* scenario_name) {
  const Scenario scenario =
      loadScenario(std::string(STEREO_NAV_SOURCE_DIR "/config/scenarios/") + scenario_name);
  return Trajectory(scenario.path, scenario.motion);
}

Trajectory standing(double duration_s) {
  PathStep wait;
  wait.action = PathStep::Action::kWait;
  wait.duration_s = duration_s;
  return Trajectory({wait}, MotionParams());
}

double yaw(const Eigen::Matrix3d& R) {
  return std::atan2(R(1, 0), R(0, 0));
}

TEST(ImuModel, AnIdealGyroIntegratesToTheTrueAttitude) {
  for (const char* name : {"arena.yaml", "turn_in_place.yaml"}) {
    const Trajectory trajectory = drive(name);
    ImuParams params;
    params.kind = ImuKind::kPerfect;
    params.rate_hz = 200.0;
    const auto samples = simulateImu(params, trajectory, trajectory.duration_s(), 1);
    Eigen::Matrix3d R = trajectory.pose(samples.front().time_s).linear();
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Eigen::Vector3d turn =
          0.5 * (*samples[i - 1].angular_velocity + *samples[i].angular_velocity) / params.rate_hz;
      R = R *
          Eigen::AngleAxisd(turn.norm(), turn.norm() > 0.0 ? turn.normalized() : Eigen::Vector3d::UnitX());
    }
    const Eigen::Matrix3d truth = trajectory.pose(samples.back().time_s).linear();
    EXPECT_LT(Eigen::AngleAxisd(truth.transpose() * R).angle(), 0.01 * M_PI / 180.0) << name;
  }
}

TEST(ImuModel, AccelerometerShowsGravityAtRestAndIntegratesToTheSpeed) {
  const Trajectory trajectory = drive("corridor.yaml");
  ImuParams params;
  params.kind = ImuKind::kPerfect;
  const auto samples = simulateImu(params, trajectory, 4.0, 1);
  EXPECT_NEAR((*samples.front().linear_acceleration - Eigen::Vector3d(0, 0, 9.81)).norm(), 0.0, 1e-6);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : samples) {
    velocity +=
        (*sample.q_world_imu * *sample.linear_acceleration - Eigen::Vector3d(0, 0, 9.81)) / params.rate_hz;
  }
  EXPECT_NEAR(velocity.x(), trajectory.state(4.0).velocity_base.x(), 0.01);
}

TEST(ImuModel, TheThesisModuleDriftsAsItsAuthorMeasured) {
  const auto samples = simulateImu(ImuParams(), standing(600.0), 600.0, 3);
  ASSERT_EQ(samples.size(), 60001u);
  EXPECT_FALSE(samples[0].angular_velocity.has_value());
  const double first = yaw(samples.front().q_world_imu->toRotationMatrix());
  const double last = yaw(samples.back().q_world_imu->toRotationMatrix());
  EXPECT_NEAR((last - first) * 180.0 / M_PI, 2.9, 0.15);
  EXPECT_NEAR(first * 180.0 / M_PI, 20.0, 0.1);   // counts from power-on
  EXPECT_NEAR(samples[100].time_s, 1.005, 1e-9);  // late by its latency
}

TEST(ImuModel, TheRawModuleHasBiasAndNoiseOfItsDensity) {
  ImuParams params;
  params.kind = ImuKind::kRaw;
  params.gyro_walk_dps2_rthz = 0.0;
  const auto samples = simulateImu(params, standing(100.0), 100.0, 4);
  EXPECT_FALSE(samples[0].q_world_imu.has_value());
  double sum = 0.0, squares = 0.0;
  for (const ImuSample& sample : samples) {
    const double rate_dps = sample.angular_velocity->z() * 180.0 / M_PI;
    sum += rate_dps;
    squares += rate_dps * rate_dps;
  }
  const double n = static_cast<double>(samples.size()), mean = sum / n;
  EXPECT_LT(std::fabs(mean), 4.0 * params.gyro_bias_dps);
  EXPECT_GT(std::fabs(mean), 1e-4);
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 0.01 * std::sqrt(100.0), 0.005);
}

TEST(ImuModel, SeedsDecide) {
  const Trajectory trajectory = standing(1.0);
  const auto a = simulateImu(ImuParams(), trajectory, 1.0, 7),
             b = simulateImu(ImuParams(), trajectory, 1.0, 7);
  const auto c = simulateImu(ImuParams(), trajectory, 1.0, 8);
  EXPECT_EQ(a[50].q_world_imu->coeffs(), b[50].q_world_imu->coeffs());
  EXPECT_NE(a[50].q_world_imu->coeffs(), c[50].q_world_imu->coeffs());
  ImuParams none;
  none.kind = ImuKind::kNone;
  EXPECT_TRUE(simulateImu(none, trajectory, 1.0, 7).empty());
}

}  // namespace
}  // namespace stereo_nav::sim
