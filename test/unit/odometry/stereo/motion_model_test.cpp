#include "odometry/stereo/motion_model.h"

#include <gtest/gtest.h>

namespace stereo_nav::odometry {
namespace {

constexpr double kPeriod_s = 0.1;

Vector6d steadyTwist() {
  Vector6d twist;
  twist << 0.05, -0.02, -0.8, 0.02, 0.3, -0.1;
  return twist;
}

class MotionModelTest : public ::testing::Test {
 protected:
  /// Adds frame number `i` of a rig that moves with `twist`; returns what the model predicted for it.
  MotionPrior step(int i, const Vector6d& twist, double offset_s = 0.0) {
    const FrameTimes times(kPeriod_s * i, kPeriod_s * i + offset_s);
    const MotionPrior prior = model.prior(times);
    vision::StereoView view;
    view.T_camera_world = expMotion(twist * kPeriod_s) * prior.T_previous_world;
    view.T_late_camera = expMotion(twist * offset_s);
    model.update(times, prior, view, Matrix6d(1e-6 * Matrix6d::Identity()));
    return prior;
  }

  void addImu(const Eigen::Vector3d& rate, double until_s) {
    for (int i = 0; 0.01 * i <= until_s; ++i) {
      ImuSample sample;
      sample.time_s = 0.01 * i;
      sample.angular_velocity = rate;
      model.addImu(sample);
    }
  }

  MotionModelParams params;
  MotionModel model{params, ImuRotationParams(), Eigen::Matrix3d::Identity()};
};

TEST_F(MotionModelTest, PredictsThatTheVelocityIsKept) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(model.prior({kPeriod_s, kPeriod_s}).predictsMotion());
  step(1, steadyTwist());
  const MotionPrior prior = model.prior({2 * kPeriod_s, 2 * kPeriod_s + 0.03});
  EXPECT_TRUE(prior.predictsMotion());
  const vision::StereoView predicted = prior.predictedView();
  EXPECT_TRUE(predicted.T_camera_world.isApprox(expMotion(2.0 * kPeriod_s * steadyTwist()), 1e-9));
  EXPECT_TRUE(predicted.T_late_camera.isApprox(expMotion(0.03 * steadyTwist()), 1e-9));
  EXPECT_TRUE(prior.twistAt(predicted).isApprox(steadyTwist(), 1e-9));
}

TEST_F(MotionModelTest, UncertaintyGrowsWithTimeAndHalvesWithAKnownVelocity) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  const MotionPrior unknown = model.prior({0.04, 0.04});
  EXPECT_NEAR(unknown.twist_sigma[0], std::sqrt(params.acceleration_density * 0.04), 1e-12);
  EXPECT_NEAR(unknown.twist_sigma[5], std::sqrt(params.angular_acceleration_density * 0.04), 1e-12);
  step(1, steadyTwist());
  const MotionPrior known = model.prior({kPeriod_s + 0.04, kPeriod_s + 0.04});
  EXPECT_NEAR(known.twist_sigma[0], 0.5 * unknown.twist_sigma[0], 1e-12);
}

TEST_F(MotionModelTest, TheImuTellsTheRotationAndWhereANewMapBegins) {
  const Eigen::Vector3d rate(0.1, -0.2, 0.3);
  addImu(rate, 1.0);
  model.start({0.2, 0.2}, Eigen::Isometry3d::Identity());
  const MotionPrior prior = model.prior({0.5, 0.55});
  ASSERT_TRUE(prior.R_current_previous);
  ASSERT_TRUE(prior.R_late_camera);
  // Coordinates turn against the camera.
  EXPECT_TRUE(prior.R_current_previous->isApprox(expRotation(-0.3 * rate), 1e-6));
  EXPECT_TRUE(prior.R_late_camera->isApprox(expRotation(-0.05 * rate), 1e-6));
  EXPECT_TRUE(prior.predictsMotion());
  EXPECT_EQ(prior.lateSigma()[5], prior.rotation_sigma_rad);
  const Coasted turned = model.coasted({0.5, 0.5}, 1.0);
  EXPECT_TRUE(turned.turn_is_measured);
  EXPECT_FALSE(turned.velocity_is_known);
  EXPECT_TRUE(turned.T_camera_world.linear().isApprox(expRotation(-0.3 * rate), 1e-6));
  EXPECT_TRUE(turned.T_camera_world.translation().isZero());
}

TEST_F(MotionModelTest, WithoutImuANewMapBeginsWhereTheLastOneEnded) {
  const Eigen::Isometry3d T_camera_world = expMotion(steadyTwist());
  model.start({0.0, 0.0}, T_camera_world);
  const Coasted coasted = model.coasted({1.0, 1.0}, 1.0);
  EXPECT_TRUE(coasted.T_camera_world.isApprox(T_camera_world));
  EXPECT_FALSE(coasted.turn_is_measured);
}

TEST_F(MotionModelTest, CoastsOnTheLastVelocityForABoundedTime) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  step(1, steadyTwist());
  EXPECT_FALSE(model.coasted({0.2, 0.2}, 1.0).velocity_is_known) << "the first motion is not trusted yet";
  model.trustPrevious();
  const Coasted coasting = model.coasted({0.5, 0.5}, 1.0);
  EXPECT_TRUE(coasting.velocity_is_known);
  EXPECT_TRUE(coasting.T_camera_world.isApprox(expMotion(0.5 * steadyTwist()), 1e-9));
  const Coasted held = model.coasted({2.0, 2.0}, 1.0);
  EXPECT_FALSE(held.velocity_is_known);
  EXPECT_TRUE(held.T_camera_world.isApprox(expMotion(1.1 * steadyTwist()), 1e-9))
      << "0.1 s and 1 s of coasting";
}

TEST_F(MotionModelTest, CoastingGrowsUncertainAsAVelocityThatChanges) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  step(1, Vector6d::Zero());
  model.trustPrevious();
  for (const double time_s : {0.2, 0.4, 0.8}) {
    const double velocity_variance =
        2e-6 / (kPeriod_s * kPeriod_s) + params.acceleration_density * kPeriod_s / 3.0;
    const double expected =
        velocity_variance * time_s * time_s + params.acceleration_density * time_s * time_s * time_s / 3.0;
    const Matrix6d covariance = model.coasted({kPeriod_s + time_s, kPeriod_s + time_s}, 1.0).covariance;
    EXPECT_NEAR(covariance(0, 0), expected, 1e-9);
  }
}

TEST_F(MotionModelTest, ExpectsWhatTheVelocityLeadsTo) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  step(1, steadyTwist());
  model.trustPrevious();
  const FrameTimes later(0.3, 0.3);
  const Eigen::Isometry3d ahead = expMotion(0.3 * steadyTwist());
  EXPECT_TRUE(model.expects(ahead, Matrix6d::Zero(), later, 1.0));
  EXPECT_FALSE(model.expects(Eigen::Translation3d(2.0, 0.0, 0.0) * ahead, Matrix6d::Zero(), later, 1.0));
  EXPECT_FALSE(model.expects(ahead, Matrix6d::Zero(), later, 0.1)) << "nothing is known after the coasting";
}

TEST_F(MotionModelTest, KnowsWhichMotionsNoRobotCouldBegin) {
  const auto motion = [](double speed_m_s) {
    Vector6d twist = Vector6d::Zero();
    twist[2] = -speed_m_s;
    return expMotion(twist * kPeriod_s);
  };
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(model.exceedsAcceleration(motion(50.0), kPeriod_s)) << "no velocity to change yet";
  step(1, Vector6d::Zero());
  // 5 sqrt(Q t) = 1.58 m/s within 0.1 s.
  EXPECT_FALSE(model.exceedsAcceleration(motion(1.5), kPeriod_s));
  EXPECT_TRUE(model.exceedsAcceleration(motion(1.7), kPeriod_s));
  Vector6d fast = Vector6d::Zero();
  fast[2] = -1.5;
  step(2, fast);
  EXPECT_FALSE(model.exceedsAcceleration(motion(3.0), kPeriod_s)) << "it is the change that counts";
}

TEST_F(MotionModelTest, ForgetsAVelocityOnce) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(model.forgetVelocity());
  step(1, steadyTwist());
  EXPECT_TRUE(model.forgetVelocity());
  EXPECT_FALSE(model.forgetVelocity());
  EXPECT_FALSE(model.prior({0.2, 0.2}).predictsMotion());
}

TEST_F(MotionModelTest, AFirstFrameWithTimeOffsetMayMoveAtAnySpeed) {
  const WindowFrame first = model.start({0.0, 0.04}, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(first.has_time_offset);
  EXPECT_TRUE(first.late_sigma.isApproxToConstant(0.04));
  EXPECT_TRUE(first.T_late_expected.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(model.start({0.0, 5e-6}, Eigen::Isometry3d::Identity()).has_time_offset) << "negligible";
}

TEST_F(MotionModelTest, InterpolatesTheMotionBetweenTheStampsOfThePreviousFrame) {
  constexpr double kOffset_s = 0.04;
  model.start({0.0, kOffset_s}, Eigen::Isometry3d::Identity());
  step(1, steadyTwist(), kOffset_s);
  const FrameTimes times(2 * kPeriod_s, 2 * kPeriod_s + kOffset_s);
  WindowFrame previous;
  previous.view = model.previousView();
  previous.late_sigma.setConstant(7.0);
  vision::StereoView current;
  current.T_camera_world = expMotion(steadyTwist() * kPeriod_s) * previous.view.T_camera_world;
  model.smoothTimeOffset(times, current, previous);
  EXPECT_TRUE(previous.T_late_expected.isApprox(expMotion(kOffset_s * steadyTwist()), 1e-9));
  const double spread = std::sqrt(kPeriod_s * kPeriod_s * kPeriod_s / 48.0);
  EXPECT_NEAR(previous.late_sigma[0], std::sqrt(params.acceleration_density) * spread, 1e-12);
  EXPECT_NEAR(previous.late_sigma[3], std::sqrt(params.angular_acceleration_density) * spread, 1e-12);
}

TEST_F(MotionModelTest, AFrameIsExpectedToMoveOnBetweenItsStamps) {
  model.start({0.0, 0.0}, Eigen::Isometry3d::Identity());
  step(1, steadyTwist());
  const MotionPrior prior = model.prior({2 * kPeriod_s, 2 * kPeriod_s - 0.05});
  const WindowFrame frame = MotionModel::windowFrame(prior.predictedView(), prior);
  EXPECT_TRUE(frame.has_time_offset);
  EXPECT_TRUE(frame.T_late_expected.isApprox(expMotion(-0.05 * steadyTwist()), 1e-9));
  EXPECT_TRUE(frame.late_sigma.isApprox(0.05 * prior.twist_sigma, 1e-9));
}

}  // namespace
}  // namespace stereo_nav::odometry
