#include "mapping/mono/mono_motion.h"

namespace stereo_nav::mapping {
namespace {

/// White noise on the derivative of a rate, over `duration_s`: of (integral, rate), as factors of the
/// identity.
struct IntegratedNoise {
  double both_integral, cross, both_rate;
};

IntegratedNoise integrated(double sigma, double duration_s) {
  const double rate = sigma * sigma * duration_s;
  return {rate * duration_s * duration_s / 3.0, rate * duration_s / 2.0, rate};
}

Matrix12d processNoise(const CameraState& camera, double duration_s, const MotionNoise& noise) {
  const auto identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d right = leftJacobian(-camera.omega_camera * duration_s);
  const IntegratedNoise way = integrated(noise.acceleration_sigma, duration_s);
  const IntegratedNoise turn = integrated(noise.turn_acceleration_sigma, duration_s);
  Matrix12d Q = Matrix12d::Zero();
  Q.block<3, 3>(0, 0) = way.both_integral * identity;
  Q.block<3, 3>(0, 6) = Q.block<3, 3>(6, 0) = way.cross * identity;
  Q.block<3, 3>(6, 6) = way.both_rate * identity;
  Q.block<3, 3>(3, 3) = turn.both_integral * right * right.transpose();
  Q.block<3, 3>(3, 9) = turn.cross * right;
  Q.block<3, 3>(9, 3) = turn.cross * right.transpose();
  Q.block<3, 3>(9, 9) = turn.both_rate * identity;
  return Q;
}

}  // namespace

CameraState movedCamera(const CameraState& camera, double duration_s, Matrix12d* transition) {
  CameraState moved = camera;
  const Eigen::Vector3d turn = camera.omega_camera * duration_s;
  moved.p_world += camera.v_world * duration_s;
  moved.q_world_camera = (camera.q_world_camera * expQuaternion(turn)).normalized();
  if (transition != nullptr) {
    transition->setIdentity();
    transition->block<3, 3>(0, 6) = duration_s * Eigen::Matrix3d::Identity();
    transition->block<3, 3>(3, 3) = expRotation(-turn);
    // exp(turn + d) = exp(turn) exp(Jr d), with the right Jacobian Jr(turn) = Jl(-turn).
    transition->block<3, 3>(3, 9) = duration_s * leftJacobian(-turn);
  }
  return moved;
}

void predict(MonoState& state, double duration_s, const MotionNoise& noise,
             const std::optional<MeasuredTurn>& turn) {
  if (turn) {
    state.camera.omega_camera = turn->omega_camera;
    Matrix12d forget = Matrix12d::Identity();
    forget.bottomRightCorner<3, 3>().setZero();
    Matrix12d measured = Matrix12d::Zero();
    measured.bottomRightCorner<3, 3>() =
        turn->sigma_rad_per_s * turn->sigma_rad_per_s * Eigen::Matrix3d::Identity();
    state.covariance.moveCamera(forget, measured);
  }
  MotionNoise left = noise;
  if (turn) left.turn_acceleration_sigma = 0.0;
  Matrix12d transition;
  const Matrix12d Q = processNoise(state.camera, duration_s, left);
  state.camera = movedCamera(state.camera, duration_s, &transition);
  state.covariance.moveCamera(transition, Q);
}

void correctByVelocity(MonoState& state, const MeasuredVelocity& velocity) {
  const Eigen::Matrix3d R_camera_world = state.camera.q_world_camera.conjugate().toRotationMatrix();
  const Eigen::Vector3d expected = R_camera_world * state.camera.v_world;
  Eigen::Matrix<double, 3, kCameraRows> H = Eigen::Matrix<double, 3, kCameraRows>::Zero();
  H.block<3, 3>(0, 3) = hat(expected);
  H.block<3, 3>(0, 6) = R_camera_world;
  const Eigen::MatrixXd PHt = state.covariance.matrix().leftCols(kCameraRows) * H.transpose();
  const Eigen::MatrixXd S = H * PHt.topRows(kCameraRows) + velocity.covariance;
  state.correct(state.covariance.update(PHt, S, velocity.v_camera - expected));
}

int addPastPose(MonoState& state) {
  StateBlock block;
  block.form = StateBlock::Form::kPastPose;
  block.pose = state.camera.T_world_camera();
  block.offset = state.covariance.size();
  block.id = state.next_id++;
  Eigen::Matrix<double, 6, kCameraRows> pose_of_camera = Eigen::Matrix<double, 6, kCameraRows>::Zero();
  pose_of_camera.leftCols<6>().setIdentity();
  state.covariance.append(pose_of_camera, Matrix6d::Zero());
  state.blocks.push_back(block);
  return block.id;
}

}  // namespace stereo_nav::mapping
