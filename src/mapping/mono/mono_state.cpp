#include "mapping/mono/mono_state.h"

#include <cmath>

namespace stereo_nav::mapping {

double MonoState::rhoSigma(const StateBlock& block) const {
  const Eigen::Index row = block.offset + 5;
  return std::sqrt(covariance.matrix()(row, row));
}

void MonoState::correct(const Eigen::VectorXd& step) {
  if (step.size() == 0) return;
  camera.p_world += step.segment<3>(0);
  camera.q_world_camera = (camera.q_world_camera * expQuaternion(step.segment<3>(3))).normalized();
  camera.v_world += step.segment<3>(6);
  camera.omega_camera += step.segment<3>(9);
  for (StateBlock& block : blocks) {
    if (block.isLandmark()) {
      block.value.head(block.rows()) += step.segment(block.offset, block.rows());
    } else {
      block.pose.translation() += step.segment<3>(block.offset);
      block.pose.linear() = block.pose.linear() * expRotation(step.segment<3>(block.offset + 3));
    }
  }
}

void MonoState::remove(std::size_t index) {
  const Eigen::Index rows = blocks[index].rows();
  covariance.remove(blocks[index].offset, rows);
  blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(index));
  for (std::size_t i = index; i < blocks.size(); ++i) blocks[i].offset -= rows;
}

Matrix6d poseCovariance(const MonoState& state) {
  const Matrix6d P = state.covariance.matrix().topLeftCorner<6, 6>();
  Matrix6d turn = Matrix6d::Identity();
  turn.bottomRightCorner<3, 3>() = state.camera.q_world_camera.toRotationMatrix();
  return turn * P * turn.transpose();
}

RelativePose relativeTo(const MonoState& state, const StateBlock& past) {
  const Eigen::Isometry3d T_world_now = state.camera.T_world_camera();
  RelativePose relative{past.pose.inverse() * T_world_now, {}};
  // The error of T_past_now in the axes of the camera now: e = xi_now - Ad(T_now_past) xi_past, with xi the
  // error of each pose in its own axes, (R^T dp, dtheta).
  const auto P = state.covariance.matrix();
  Matrix6d now = Matrix6d::Identity();
  now.topLeftCorner<3, 3>() = T_world_now.linear().transpose();
  Matrix6d then = Matrix6d::Identity();
  then.topLeftCorner<3, 3>() = past.pose.linear().transpose();
  const Matrix6d carried = -adjoint(relative.T_past_now.inverse()) * then;
  const Matrix6d cross = now * P.block<6, 6>(0, past.offset) * carried.transpose();
  relative.covariance = now * P.topLeftCorner<6, 6>() * now.transpose() +
                        carried * P.block<6, 6>(past.offset, past.offset) * carried.transpose() + cross +
                        cross.transpose();
  return relative;
}

}  // namespace stereo_nav::mapping
