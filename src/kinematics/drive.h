#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/drive_params.h"
#include "kinematics/twist.h"

namespace stereo_nav::kinematics {

/// What a wheel does: the speed of its circumference and, of a steered wheel, its angle (else 0).
struct WheelState {
  double speed_m_per_s = 0.0;
  double steering_rad = 0.0;
};

/// The twist that explains the wheels best.
struct ForwardResult {
  Twist twist = Twist::Zero();
  /// Root mean square of what the wheels contradict each other, in m/s per redundant equation; 0 without
  /// redundancy. It grows when a wheel slips or an encoder fails.
  double slip_m_per_s = 0.0;
};

/// The equations of one wheel (Campion, Bastin, D'Andrea-Novel 1996, "Structural properties and
/// classification of kinematic and dynamic models of wheeled mobile robots", eq. 5 to 10): the contact point
/// moves with v + omega x p, and the wheel turns with the part of it that its rollers do not take up.
struct WheelRows {
  Eigen::RowVector3d rolling;   ///< times the twist: speed of the circumference
  Eigen::RowVector3d sideways;  ///< times the twist: speed across a plain wheel, which is zero without slip
  bool has_sideways;            ///< false for wheels with rollers
};

/// One formulation for all drives: each wheel gives one row or two of a matrix that takes twists to wheel
/// speeds.
class Drive {
 public:
  /// Throws ParameterError when the wheels leave a motion of the base undetermined, or a wheel's rollers run
  /// along it.
  explicit Drive(const DriveParams& params);

  const DriveParams& params() const { return params_; }
  std::size_t size() const { return params_.wheels.size(); }
  bool steered(std::size_t wheel) const { return params_.wheels[wheel].kind == WheelKind::kSteered; }

  /// The nearest twist that no fixed wheel and no steering limit forbids: a differential drive does not move
  /// sideways, an Ackermann drive turns on circles of a least radius.
  Twist nearestPossible(const Twist& twist) const;

  /// Speeds and angles for a twist, after nearestPossible(). A steered wheel that stands still gets the angle
  /// 0; WheelCommander holds the former one.
  std::vector<WheelState> inverse(const Twist& twist) const;

  /// Least squares over all rows. `wheels` in the order of the parameters.
  ForwardResult forward(const std::vector<WheelState>& wheels) const;

  /// Rows of a wheel at a steering angle, which is ignored for wheels that are not steered.
  WheelRows rows(std::size_t wheel, double steering_rad) const;

 private:
  WheelRows rowsAt(const WheelParams& wheel, double steering_rad) const;
  void checkDetermined() const;

  DriveParams params_;
  std::vector<WheelRows> straight_;  ///< rows at a steering angle of zero
  Eigen::Matrix3d allowed_;          ///< projection onto the twists that the fixed wheels allow
  Eigen::Vector2d fixed_direction_ = Eigen::Vector2d::UnitX();  ///< in which a fixed wheel rolls
  bool has_fixed_ = false;
};

}  // namespace stereo_nav::kinematics
