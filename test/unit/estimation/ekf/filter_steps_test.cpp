#include <gtest/gtest.h>

#include <cmath>

#include "estimation/ekf/correction.h"
#include "estimation/ekf/observation.h"
#include "estimation/ekf/odometry_motion.h"
#include "estimation/ekf/prediction.h"
#include "estimation/ekf/rest.h"

namespace stereo_nav::estimation::test {
namespace {

using namespace error_row;

StateParts allParts() {
  StateParts parts;
  parts.gyro = parts.accelerometer = parts.wheel_scales = parts.wheel_turns = true;
  parts.anchors = 1;
  return parts;
}

State someState(const StateLayout& layout) {
  State state;
  state.T_world_base = expMotion((Vector6d() << 0.3, -0.2, 0.1, 0.2, -0.1, 0.7).finished());
  state.velocity << 0.5, 0.2, -0.1;
  state.rate << 0.1, -0.2, 0.4;
  state.acceleration << 0.3, 0.1, -0.2;
  state.gyro_bias << 0.01, 0.02, -0.01;
  state.accelerometer_bias << 0.1, -0.1, 0.05;
  state.wheel_scale << 0.02, -0.07, 0.05, 0.04, -0.03, 0.01;
  state.anchors.assign(1, expMotion((Vector6d() << 0.28, -0.22, 0.11, 0.18, -0.12, 0.65).finished()));
  state.covariance = Eigen::MatrixXd::Identity(layout.rows(), layout.rows()) * 1e-4;
  return state;
}

/// The error that takes one pose to another, in its own axes.
Vector6d poseError(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  Vector6d error;
  error << from.linear().transpose() * (to.translation() - from.translation()),
      logRotation(Eigen::Matrix3d(from.linear().transpose() * to.linear()));
  return error;
}

TEST(Prediction, JacobianIsThatOfNumericDifferences) {
  const StateLayout layout(allParts());
  const State state = someState(layout);
  constexpr double kStep_s = 0.02, kSmall = 1e-6;
  const ProcessNoise noise;
  State end = state;
  predict(layout, noise, state.time_s + kStep_s, end);
  const auto F = transitionOf(state, kStep_s, noise.acceleration_decay_s);
  for (int row = 0; row < kGyroBias; ++row) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(layout.rows());
    error[layout.at(row)] = kSmall;
    State moved = state;
    layout.add(error, moved);
    predict(layout, noise, state.time_s + kStep_s, moved);
    Eigen::Matrix<double, 15, 1> numeric;
    numeric << poseError(end.T_world_base, moved.T_world_base), moved.velocity - end.velocity,
        moved.rate - end.rate, moved.acceleration - end.acceleration;
    numeric /= kSmall;
    EXPECT_LT((numeric - F.col(row).head<15>()).cwiseAbs().maxCoeff(), 1e-4) << "row " << row;
  }
}

TEST(Prediction, NoiseDoesNotDependOnHowTheTimeIsDivided) {
  const StateLayout layout(allParts());
  const ProcessNoise noise;
  State once = someState(layout), often = once;
  predict(layout, noise, 0.05, once);
  for (int i = 1; i <= 50; ++i) predict(layout, noise, i * 0.001, often);
  EXPECT_LT((once.covariance - often.covariance).cwiseAbs().maxCoeff(),
            2e-3 * once.covariance.cwiseAbs().maxCoeff());
  EXPECT_LT((once.T_world_base.translation() - often.T_world_base.translation()).norm(), 2e-5);
}

TEST(Prediction, NoiseOfAVelocityIntegratesToTheKnownAnswer) {
  StateParts parts;
  parts.planar = true;
  const StateLayout layout(parts);
  ProcessNoise noise;
  noise.position.setZero();
  noise.velocity.setConstant(0.3);
  State state;
  state.covariance = Eigen::MatrixXd::Zero(layout.rows(), layout.rows());
  predict(layout, noise, 2.0, state);
  // q t^3 / 3, q t^2 / 2, q t
  EXPECT_NEAR(state.covariance(layout.at(kPosition), layout.at(kPosition)), 0.3 * 8.0 / 3.0, 1e-9);
  EXPECT_NEAR(state.covariance(layout.at(kPosition), layout.at(kVelocity)), 0.3 * 4.0 / 2.0, 1e-9);
  EXPECT_NEAR(state.covariance(layout.at(kVelocity), layout.at(kVelocity)), 0.3 * 2.0, 1e-9);
}

/// Compares H with how the residual changes.
void expectObservation(const Measurement& measurement, bool wheels, double tolerance) {
  const StateLayout layout(allParts());
  const State state = someState(layout);
  const Innovation innovation = observe(layout, state, measurement, wheels, 9.81);
  constexpr double kSmall = 1e-6;
  for (int i = 0; i < layout.rows(); ++i) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(layout.rows());
    error[i] = kSmall;
    State moved = state;
    layout.add(error, moved);
    const Innovation after = observe(layout, moved, measurement, wheels, 9.81);
    const Eigen::VectorXd numeric = -(after.residual - innovation.residual) / kSmall;
    EXPECT_LT((numeric - innovation.H.col(i)).cwiseAbs().maxCoeff(), tolerance) << "row " << i;
  }
}

Measurement measurementOf(Measurement::Kind kind, std::vector<int> fields) {
  Measurement measurement;
  measurement.kind = kind;
  measurement.fields = std::move(fields);
  measurement.pose = expMotion((Vector6d() << 0.2, 0.1, 0.0, 0.15, -0.05, 0.6).finished());
  measurement.value << 0.4, 0.1, 9.0, 0.1, 0.0, 0.3;
  measurement.covariance.setIdentity();
  measurement.p_base_sensor << 0.2, -0.1, 0.3;
  return measurement;
}

TEST(Observation, JacobiansAreThoseOfNumericDifferences) {
  using Kind = Measurement::Kind;
  expectObservation(measurementOf(Kind::kPose, {0, 1, 2, 3, 4, 5}), false, 1e-4);
  expectObservation(measurementOf(Kind::kTwist, {0, 1, 2, 3, 4, 5}), false, 1e-6);
  expectObservation(measurementOf(Kind::kTwist, {0, 1, 5}), true, 1e-5);
  expectObservation(measurementOf(Kind::kRate, {3, 4, 5}), false, 1e-6);
  expectObservation(measurementOf(Kind::kAcceleration, {0, 1, 2}), false, 1e-4);
}

TEST(Observation, JacobianOfAnAnchorIsThatOfNumericDifferences) {
  const StateLayout layout(allParts());
  State state = someState(layout);
  state.anchors[0] =
      state.T_world_base * expMotion((Vector6d() << 0.02, -0.01, 0.0, 0.0, 0.0, 0.01).finished());
  const std::vector<int> fields = {0, 1, 2, 3, 4, 5};
  const Innovation innovation = observeAnchor(layout, state, 0, fields, Vector6d::Ones());
  for (int i = 0; i < layout.rows(); ++i) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(layout.rows());
    error[i] = 1e-6;
    State moved = state;
    layout.add(error, moved);
    const Eigen::VectorXd numeric =
        -(observeAnchor(layout, moved, 0, fields, Vector6d::Ones()).residual - innovation.residual) / 1e-6;
    EXPECT_LT((numeric - innovation.H.col(i)).cwiseAbs().maxCoeff(), 0.02) << "row " << i;
  }
}

TEST(Observation, AnAnchorThatMovesCarriesTheErrorOfThePoseItWasClonedFrom) {
  StateParts parts;
  parts.planar = true;
  parts.anchors = 1;
  const StateLayout layout(parts);
  State state;
  state.anchors.resize(1, Eigen::Isometry3d::Identity());
  state.covariance = Eigen::MatrixXd::Identity(layout.rows(), layout.rows()) * 0.01;
  cloneAnchor(layout, 0, {0, 1, 2, 3, 4, 5}, state);
  EXPECT_NEAR(state.covariance(layout.at(kAnchors), layout.at(kPosition)), 0.01, 1e-15);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation().x() = 2.0;
  moveAnchor(layout, 0, motion, Matrix6d::Zero(), false, state);
  // A turned start moves the end sideways: 0.01 (1 + 2^2).
  EXPECT_NEAR(state.covariance(layout.at(kAnchors + 1), layout.at(kAnchors + 1)), 0.05, 1e-12);
  EXPECT_NEAR(state.anchors[0].translation().x(), 2.0, 1e-12);
}

TEST(Correction, IsThatOfTheInformationForm) {
  const StateLayout layout(allParts());
  State state = someState(layout);
  Innovation innovation =
      observe(layout, state, measurementOf(Measurement::Kind::kTwist, {0, 1, 5}), false, 9.81);
  innovation.noise *= 1e-4;
  const Eigen::MatrixXd expected =
      (state.covariance.inverse() + innovation.H.transpose() * innovation.noise.inverse() * innovation.H)
          .inverse();
  ASSERT_TRUE(weigh(state, innovation));
  ASSERT_TRUE(correct(layout, innovation, state));
  EXPECT_LT((state.covariance - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(OdometryMotion, CovarianceIsWhatThatOfThePoseHasGrownBy) {
  ChannelMemory memory;
  memory.anchored_s = 1.0;
  memory.odometry_covariance = Matrix6d::Identity() * 0.01;
  Measurement measurement = measurementOf(Measurement::Kind::kMotion, {0, 1, 2, 3, 4, 5});
  measurement.time_s = 1.1;
  measurement.pose.setIdentity();
  measurement.covariance = Matrix6d::Identity() * 0.013;
  EXPECT_NEAR(motionSince(memory, measurement).covariance(0, 0), 0.003, 1e-9);
  EXPECT_NEAR(motionSince(memory, measurement).covariance(5, 5), 0.003, 1e-9);
}

TEST(OdometryMotion, TheTwistSaysItWhereThePosesCovarianceStays) {
  ChannelMemory memory;
  memory.anchored_s = 1.0;
  memory.odometry_covariance = Matrix6d::Identity() * 1000.0;
  Measurement measurement = measurementOf(Measurement::Kind::kMotion, {0, 1, 5});
  measurement.time_s = 1.1;
  measurement.covariance = memory.odometry_covariance;
  measurement.twist_covariance = Matrix6d::Identity() * 0.04;
  EXPECT_NEAR(motionSince(memory, measurement).covariance(0, 0), 0.04 * 0.01, 1e-12);
}

TEST(OdometryMotion, WhatTheSpeedDoesNotTellIsLooserThanThePosesCovarianceGrows) {
  ChannelMemory memory;
  memory.anchored_s = 1.0;
  memory.odometry_covariance = Matrix6d::Identity() * 0.01;
  Measurement measurement = measurementOf(Measurement::Kind::kMotion, {0, 1, 5});
  measurement.time_s = 1.1;
  measurement.pose.setIdentity();
  measurement.covariance = Matrix6d::Identity() * 0.011;
  // As in a corridor: 1 m/s along it, 0.01 m/s across.
  measurement.twist_covariance = Matrix6d::Identity() * 1e-4;
  (*measurement.twist_covariance)(0, 0) = 1.0;
  const Matrix6d covariance = motionSince(memory, measurement).covariance;
  EXPECT_NEAR(covariance(0, 0), 0.001 + 0.01 * 60.0 / 0.1, 1e-9);
  EXPECT_NEAR(covariance(1, 1), 0.001, 1e-9);
}

TEST(Rest, TeachesTheWheelsNoScale) {
  StateParts parts;
  parts.planar = parts.wheel_scales = true;
  const StateLayout layout(parts);
  State state;
  state.velocity.x() = 0.03;
  state.covariance = Eigen::MatrixXd::Identity(layout.rows(), layout.rows()) * 1e-2;
  const int speed = layout.at(kVelocity), scale = layout.at(kScale);
  state.covariance(speed, scale) = state.covariance(scale, speed) = 5e-3;
  Innovation innovation = observeRest(layout, state);
  ASSERT_TRUE(weigh(state, innovation));
  ASSERT_TRUE(correct(layout, innovation, state));
  EXPECT_NEAR(state.velocity.x(), 0.0, 1e-4);
  EXPECT_EQ(state.wheel_scale[0], 0.0);
  EXPECT_NEAR(state.covariance(scale, scale), 1e-2, 1e-12);
}

TEST(Rest, IsNotShownByAnOdometryThatSeesNoWay) {
  ChannelMemory memory;
  memory.anchored = true;
  memory.anchored_s = 1.0;
  memory.odometry_covariance = Matrix6d::Identity() * 1e-4;
  Measurement measurement = measurementOf(Measurement::Kind::kMotion, {0, 1, 5});
  measurement.time_s = 1.1;
  measurement.pose.setIdentity();
  measurement.covariance = Matrix6d::Identity() * 1.01e-4;
  EXPECT_TRUE(tellsWay(measurement, memory));
  measurement.covariance(0, 0) = 0.01;
  EXPECT_FALSE(tellsWay(measurement, memory));
}

}  // namespace
}  // namespace stereo_nav::estimation::test
