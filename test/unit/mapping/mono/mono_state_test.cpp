#include "mapping/mono/mono_state.h"

#include <gtest/gtest.h>

#include "mapping/mono/mono_motion.h"
#include "point_world.h"

namespace stereo_nav::mapping {
namespace {

Eigen::MatrixXd someCovariance(Eigen::Index size) {
  std::srand(3);
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size);
  return root * root.transpose() + Eigen::MatrixXd::Identity(size, size);
}

TEST(MonoState, ThePlainFilterGivesTheSameCorrection) {
  const Eigen::MatrixXd P = someCovariance(20);
  JointCovariance covariance(30);
  covariance.start(P);
  const Eigen::MatrixXd H = Eigen::MatrixXd::Random(6, 20);
  const Eigen::MatrixXd S = H * P * H.transpose() + 0.3 * Eigen::MatrixXd::Identity(6, 6);
  const Eigen::VectorXd innovation = Eigen::VectorXd::Random(6);
  const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
  EXPECT_LT((covariance.update(P * H.transpose(), S, innovation) - K * innovation).norm(), 1e-10);
  EXPECT_LT((covariance.matrix() - (P - K * S * K.transpose())).norm(), 1e-9);
  EXPECT_EQ(covariance.matrix(), Eigen::MatrixXd(covariance.matrix().transpose()));
}

TEST(MonoState, ABlockThatLeavesTakesItsRowsAndNoOthers) {
  const Eigen::MatrixXd P = someCovariance(10);
  JointCovariance covariance(10);
  covariance.start(P);
  covariance.remove(3, 4);
  ASSERT_EQ(covariance.size(), 6);
  EXPECT_EQ(Eigen::MatrixXd(covariance.matrix().topLeftCorner(3, 3)), P.topLeftCorner(3, 3));
  EXPECT_EQ(Eigen::MatrixXd(covariance.matrix().bottomRightCorner(3, 3)), P.bottomRightCorner(3, 3));
  EXPECT_EQ(Eigen::MatrixXd(covariance.matrix().bottomLeftCorner(3, 3)), P.bottomLeftCorner(3, 3));
}

TEST(MonoState, AMeasuredTurnReplacesTheRateOfTheFilter) {
  MonoState state(kCameraRows);
  state.covariance.start(Matrix12d::Identity());
  predict(state, 0.1, {}, MeasuredTurn{{0.0, 0.0, 1.0}, 0.01});
  EXPECT_NEAR(logRotation(state.camera.q_world_camera).z(), 0.1, 1e-12);
  EXPECT_NEAR(state.covariance.matrix()(11, 11), 1e-4, 1e-12);
  EXPECT_NEAR(state.covariance.matrix()(5, 5), 1.0 + 1e-6, 1e-9);
}

TEST(MonoState, AMeasuredVelocityTurnsWithTheCamera) {
  MonoState state(kCameraRows);
  state.camera.q_world_camera = expQuaternion({0.0, M_PI / 2.0, 0.0});  // looks along x
  Matrix12d P = Matrix12d::Zero();
  P.diagonal().segment<3>(6).setOnes();
  state.covariance.start(P);
  correctByVelocity(state, {{0.0, 0.0, 2.0}, 1e-8 * Eigen::Matrix3d::Identity()});
  EXPECT_LT((state.camera.v_world - Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 1e-6);
}

TEST(MonoState, TheCovarianceOfARelativePoseIsThatOfTheMotionSince) {
  MonoState state(kCameraRows + 6);
  state.camera.q_world_camera = expQuaternion({0.4, 0.2, -0.3});
  state.camera.v_world = {0.3, -0.1, 0.5};
  Matrix12d P = Matrix12d::Zero();
  P.diagonal() << 1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.01, 0.01, 0.01, 0.02, 0.02, 0.02;
  state.covariance.start(P);
  addPastPose(state);
  EXPECT_LT(relativeTo(state, state.blocks[0]).covariance.norm(), 1e-9);
  // The velocity was uncertain, in axes of the world: after 1 s the way is as uncertain, whatever the place.
  predict(state, 1.0, {1e-4, 1e-4});
  const RelativePose relative = relativeTo(state, state.blocks[0]);
  const Eigen::Vector3d way = state.blocks[0].pose.linear().transpose() * state.camera.v_world;
  EXPECT_LT((relative.T_past_now.translation() - way).norm(), 1e-12);
  EXPECT_NEAR((relative.covariance.bottomRightCorner<3, 3>().trace()), 0.06, 1e-3);
}

}  // namespace
}  // namespace stereo_nav::mapping
