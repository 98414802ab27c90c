#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// One line of a scenario's path. Neighbouring kDriveTo steps are passed without a stop on one smooth curve.
struct PathStep {
  enum class Action { kDriveTo, kTurn, kWait };
  Action action = Action::kDriveTo;
  double x_m = 0.0;  ///< kDriveTo: way-point
  double y_m = 0.0;
  double angle_deg = 0.0;   ///< kTurn: on the spot, positive to the left
  double duration_s = 1.0;  ///< kWait

  void describe(ParameterVisitor& visitor);
};

/// How the robot moves along its path.
struct MotionParams {
  double max_speed_mps = 0.4;
  double max_acceleration_mps2 = 0.4;
  double max_yaw_rate_dps = 45.0;
  double speed_variation = 0.15;  ///< a hand that pushes is not even: share of the speed
  double sway_deg = 0.15;         ///< roll and pitch while driving at full speed

  void describe(ParameterVisitor& visitor);
};

/// Pose of the base at a time: T_world_base.
using BasePath = std::function<Eigen::Isometry3d(double time_s)>;

/// Motion of `base_link` (on the floor, x forward, y left, z up) in the world, whose origin is the start.
struct BaseState {
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_base = Eigen::Vector3d::Zero();          ///< m/s, in base coordinates
  Eigen::Vector3d angular_velocity_base = Eigen::Vector3d::Zero();  ///< rad/s, in base coordinates
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();     ///< m/s^2, without gravity
};

/// When `base_link` passes a way-point, and where that is (x, y in the world, m).
struct WaypointPassing {
  double time_s;
  Eigen::Vector2d position;
};

/// A smooth motion that obeys the robot's constraint: it moves only along its own x axis, or turns on the
/// spot. Before time 0 and after the end it stands. Const methods may be called from several threads.
class Trajectory {
 public:
  Trajectory(const std::vector<PathStep>& steps, const MotionParams& motion);
  ~Trajectory();
  Trajectory(Trajectory&&) noexcept;

  double duration_s() const { return duration_s_; }
  Eigen::Isometry3d pose(double time_s) const;
  /// Derivatives by central differences of the pose.
  BaseState state(double time_s) const;
  /// When and where the way-points of the kDriveTo steps are passed.
  const std::vector<WaypointPassing>& waypoints() const { return waypoints_; }

 private:
  class Piece;
  class Wait;
  class Turn;
  class Drive;

  void append(std::unique_ptr<Piece> piece);

  MotionParams motion_;
  std::vector<std::unique_ptr<Piece>> pieces_;
  std::vector<double> starts_s_;
  std::vector<WaypointPassing> waypoints_;
  double duration_s_ = 0.0;
};

}  // namespace stereo_nav::sim
