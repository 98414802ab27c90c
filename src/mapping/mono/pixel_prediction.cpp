#include "mapping/mono/pixel_prediction.h"

#include "mapping/mono/inverse_depth.h"
#include "mapping/mono/mono_motion.h"

namespace stereo_nav::mapping {
namespace {

/// Direction to the landmark in the axes of the world: of any length, that of a point far away is finite.
Eigen::Vector3d directionTo(const StateBlock& landmark, const Eigen::Vector3d& p_world) {
  if (landmark.form == StateBlock::Form::kPoint) return landmark.value.head<3>() - p_world;
  return landmark.value(5) * (landmark.value.head<3>() - p_world) +
         inverseDepthRay(landmark.value(3), landmark.value(4));
}

/// Derivative of the direction by the landmark, and its factor by the position.
double directionBy(const StateBlock& landmark, const Eigen::Vector3d& p_world,
                   Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 6>& by_landmark) {
  by_landmark.resize(3, landmark.rows());
  if (landmark.form == StateBlock::Form::kPoint) {
    by_landmark.setIdentity();
    return -1.0;
  }
  const double rho = landmark.value(5);
  by_landmark.leftCols<3>() = rho * Eigen::Matrix3d::Identity();
  by_landmark.middleCols<2>(3) = inverseDepthRayByAngles(landmark.value(3), landmark.value(4));
  by_landmark.col(5) = landmark.value.head<3>() - p_world;
  return -rho;
}

/// When the row of a pixel is taken, after the middle row.
double rowTime_s(const MonoCamera& camera, const Eigen::Vector2d& px, double readout_s) {
  return readout_s * ((px.y() + 0.5) / camera.size.height - 0.5);
}

/// The camera when the landmark's row is taken, and how much later that is.
struct RowPose {
  CameraState state;
  double after_s = 0.0;
};

std::optional<RowPose> poseOfRow(const MonoCamera& camera, const CameraState& state,
                                 const StateBlock& landmark, double readout_s) {
  if (readout_s == 0.0) return RowPose{state, 0.0};
  const auto middle = camera.project(state.q_world_camera.conjugate() * directionTo(landmark, state.p_world));
  if (!middle) return std::nullopt;
  const double after_s = rowTime_s(camera, middle->px, readout_s);
  return RowPose{movedCamera(state, after_s), after_s};
}

}  // namespace

std::optional<Eigen::Vector2d> pixelOf(const MonoCamera& camera, const CameraState& state,
                                       const StateBlock& landmark, double readout_s) {
  const auto row = poseOfRow(camera, state, landmark, readout_s);
  if (!row) return std::nullopt;
  const auto projected =
      camera.project(row->state.q_world_camera.conjugate() * directionTo(landmark, row->state.p_world));
  if (!projected) return std::nullopt;
  return projected->px;
}

std::optional<ExpectedPixel> expectedPixel(const MonoCamera& camera, const CameraState& state,
                                           const StateBlock& landmark, double readout_s) {
  const auto row = poseOfRow(camera, state, landmark, readout_s);
  if (!row) return std::nullopt;
  const Eigen::Matrix3d R_camera_world = row->state.q_world_camera.conjugate().toRotationMatrix();
  const Eigen::Vector3d p_camera = R_camera_world * directionTo(landmark, row->state.p_world);
  const auto projected = camera.project(p_camera);
  if (!projected) return std::nullopt;
  ExpectedPixel expected;
  expected.px = projected->px;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 6> by_landmark;
  const double by_position = directionBy(landmark, row->state.p_world, by_landmark);
  expected.by_direction = projected->by_point * R_camera_world;
  expected.by_landmark = expected.by_direction * by_landmark;
  Eigen::Matrix<double, 2, kCameraRows> by_row_pose = Eigen::Matrix<double, 2, kCameraRows>::Zero();
  by_row_pose.leftCols<3>() = by_position * expected.by_direction;
  by_row_pose.middleCols<3>(3) = projected->by_point * hat(p_camera);
  expected.by_camera = by_row_pose;
  if (row->after_s != 0.0) {
    Matrix12d transition;
    movedCamera(state, row->after_s, &transition);
    expected.by_camera = by_row_pose * transition;
  }
  return expected;
}

Eigen::Matrix<double, Eigen::Dynamic, 2> covarianceWith(const MonoState& state, const StateBlock& landmark,
                                                        const ExpectedPixel& expected) {
  const auto P = state.covariance.matrix();
  Eigen::Matrix<double, Eigen::Dynamic, 2> PHt = P.leftCols<kCameraRows>() * expected.by_camera.transpose();
  PHt.noalias() += P.middleCols(landmark.offset, landmark.rows()) * expected.by_landmark.transpose();
  return PHt;
}

Eigen::Matrix2d pixelNoise(const MonoState& state, const StateBlock& landmark, const ExpectedPixel& expected,
                           double pixel_sigma_px) {
  Eigen::Matrix2d noise = pixel_sigma_px * pixel_sigma_px * Eigen::Matrix2d::Identity();
  if (landmark.form != StateBlock::Form::kInverseDepth) return noise;
  const auto P = state.covariance.matrix();
  const Eigen::Index first = landmark.offset;
  const Eigen::Matrix3d cross = P.block<3, 3>(0, first);
  const Eigen::Matrix3d moved =
      P.topLeftCorner<3, 3>() + P.block<3, 3>(first, first) - cross - cross.transpose();
  const double rho_variance = P(first + 5, first + 5);
  noise += rho_variance * expected.by_direction * moved * expected.by_direction.transpose();
  return noise;
}

Eigen::Matrix2d innovationCovariance(const MonoState& state, const StateBlock& landmark,
                                     const ExpectedPixel& expected, double pixel_sigma_px) {
  const auto P = state.covariance.matrix();
  const Eigen::Index offset = landmark.offset;
  const Eigen::Index rows = landmark.rows();
  const Eigen::Matrix2d cross =
      expected.by_camera * P.block(0, offset, kCameraRows, rows) * expected.by_landmark.transpose();
  return expected.by_camera * P.topLeftCorner<kCameraRows, kCameraRows>() * expected.by_camera.transpose() +
         expected.by_landmark * P.block(offset, offset, rows, rows) * expected.by_landmark.transpose() +
         cross + cross.transpose() + pixelNoise(state, landmark, expected, pixel_sigma_px);
}

}  // namespace stereo_nav::mapping
