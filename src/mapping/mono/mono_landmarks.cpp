#include "mapping/mono/mono_landmarks.h"

#include "mapping/mono/inverse_depth.h"
#include "mapping/mono/mono_motion.h"

namespace stereo_nav::mapping {
namespace {

StateBlock& append(MonoState& state, StateBlock block, const Eigen::MatrixXd& by_camera,
                   const Eigen::MatrixXd& noise) {
  block.offset = state.covariance.size();
  block.id = state.next_id++;
  state.covariance.append(by_camera, noise);
  state.blocks.push_back(block);
  return state.blocks.back();
}

}  // namespace

StateBlock& addInverseDepth(MonoState& state, const MonoCamera& camera, const Eigen::Vector2d& px,
                            double pixel_sigma_px, const DepthPrior& depth, double readout_s) {
  const double after_s = readout_s * ((px.y() + 0.5) / camera.size.height - 0.5);
  Matrix12d transition;
  const CameraState row = movedCamera(state.camera, after_s, &transition);
  const Eigen::Matrix3d R = row.q_world_camera.toRotationMatrix();
  const Eigen::Vector3d ray_camera = camera.ray(px);
  const Eigen::Vector3d ray_world = R * ray_camera;
  const Eigen::Matrix<double, 2, 3> angles_by_ray = anglesByDirection(ray_world);

  StateBlock block;
  block.form = StateBlock::Form::kInverseDepth;
  block.value << row.p_world, anglesOf(ray_world), depth.rho;
  Eigen::Matrix<double, 6, kCameraRows> by_row = Eigen::Matrix<double, 6, kCameraRows>::Zero();
  by_row.topLeftCorner<3, 3>().setIdentity();
  by_row.block<2, 3>(3, 3) = -angles_by_ray * R * hat(ray_camera);
  const Eigen::Matrix2d angles_by_px = angles_by_ray * R.leftCols<2>() * camera.rayByPixel(px);
  Matrix6d noise = Matrix6d::Zero();
  noise.block<2, 2>(3, 3) = pixel_sigma_px * pixel_sigma_px * angles_by_px * angles_by_px.transpose();
  noise(5, 5) = depth.rho_sigma * depth.rho_sigma;
  return append(state, block, by_row * transition, noise);
}

StateBlock& addKnownPoint(MonoState& state, const Eigen::Vector3d& p_world, double sigma_m) {
  StateBlock block;
  block.form = StateBlock::Form::kPoint;
  block.value.head<3>() = p_world;
  return append(state, block, Eigen::MatrixXd::Zero(3, kCameraRows),
                sigma_m * sigma_m * Eigen::Matrix3d::Identity());
}

void convertToPoints(MonoState& state, double linearity_index) {
  Eigen::Index saved = 0;
  for (StateBlock& block : state.blocks) {
    block.offset -= saved;
    if (block.form != StateBlock::Form::kInverseDepth) continue;
    if (linearityIndex(block.value, state.rhoSigma(block), state.camera.p_world) >= linearity_index) continue;
    state.covariance.replace(block.offset, pointByInverseDepth(block.value));
    block.value.head<3>() = pointOf(block.value);
    block.value.tail<3>().setZero();
    block.form = StateBlock::Form::kPoint;
    saved += 3;
  }
}

}  // namespace stereo_nav::mapping
