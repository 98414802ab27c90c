#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "mapping/mono/joint_covariance.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::mapping {

struct FirstView;

/// Rows of the camera in the covariance: errors of position (world), rotation, velocity (world), rate of
/// turn.
constexpr Eigen::Index kCameraRows = 12;
using Matrix12d = Eigen::Matrix<double, kCameraRows, kCameraRows>;

/// The camera, optical axes. Its errors are p + dp, R exp(dtheta) (axes of the camera), v + dv, omega +
/// domega.
struct CameraState {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();                   ///< m
  Eigen::Quaterniond q_world_camera = Eigen::Quaterniond::Identity();  ///< takes camera to world
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();                   ///< m/s
  Eigen::Vector3d omega_camera = Eigen::Vector3d::Zero();              ///< rad/s, axes of the camera

  Eigen::Isometry3d T_world_camera() const { return Eigen::Translation3d(p_world) * q_world_camera; }
};

/// Something in the state besides the camera: a landmark, or a pose that the camera had.
struct StateBlock {
  enum class Form {
    kInverseDepth,  ///< `value` as inverse_depth.h has it
    kPoint,         ///< X, Y, Z in the first three of `value`, m
    kPastPose       ///< T_world_camera in `pose`; errors as those of the camera
  };
  Form form = Form::kPoint;
  Eigen::Index offset = 0;  ///< of its first row in the covariance
  Vector6d value = Vector6d::Zero();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();

  int id = 0;                             ///< counts up
  std::shared_ptr<const FirstView> view;  ///< what it looked like; none in tests of the geometry
  int searched = 0;                       ///< frames that should have seen it
  int found = 0;                          ///< those that did
  int last_found = 0;                     ///< number of the last frame that did

  Eigen::Index rows() const { return form == Form::kPoint ? 3 : 6; }
  bool isLandmark() const { return form != Form::kPastPose; }
};

/// All that the filter estimates.
struct MonoState {
  explicit MonoState(Eigen::Index capacity) : covariance(capacity) {}

  CameraState camera;
  std::vector<StateBlock> blocks;  ///< in the order of their rows
  JointCovariance covariance;
  int next_id = 0;

  /// Standard deviation of the inverse depth of a block.
  double rhoSigma(const StateBlock& block) const;
  /// Adds the step of a correction to everything.
  void correct(const Eigen::VectorXd& step);
  /// Leaves a block out.
  void remove(std::size_t index);
};

/// Covariance of (position, rotation) in the axes of the world.
Matrix6d poseCovariance(const MonoState& state);

/// The pose relative to that of a past pose in the state, and its covariance in the axes of the camera now.
struct RelativePose {
  Eigen::Isometry3d T_past_now;
  Matrix6d covariance;
};
RelativePose relativeTo(const MonoState& state, const StateBlock& past);

}  // namespace stereo_nav::mapping
