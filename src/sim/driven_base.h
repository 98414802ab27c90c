#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "kinematics/drive.h"
#include "kinematics/wheel_commander.h"
#include "sensors/base/emulation/emulated_wheel.h"
#include "sim/driven_params.h"
#include "sim/random.h"
#include "sim/wheel_model.h"

namespace stereo_nav::sim {

/// A base that follows cmd_vel as one behind base_bridge does: velocities become commands for the nominal
/// wheels, motors with a lag follow these, and the true wheels move the base. Deterministic in `seed`.
class DrivenBase {
 public:
  DrivenBase(const DrivenParams& params, const WheelModelParams& wheels, const DrivenRig& rig,
             std::uint64_t seed);

  /// A velocity that was received now. It acts on the next command of the wheels.
  void command(const kinematics::Twist& twist);

  /// Lets a step pass; returns the velocity of the base in it, where nothing stands in its way.
  kinematics::Twist step(double duration_s);

  SimulatedTicks ticks() const;
  const kinematics::DriveParams& trueWheels() const { return true_drive_.params(); }
  double time_s() const { return time_s_; }

 private:
  using Wheels = std::vector<kinematics::WheelState>;

  void commandWheels();
  void followCommands(double duration_s);

  DrivenParams params_;
  DrivenRig rig_;
  double slip_sigma_m_;
  kinematics::Drive true_drive_;
  kinematics::WheelCommander commander_;
  std::vector<base::EmulatedWheel> wheels_;
  RandomStream slip_;
  std::vector<double> slipped_m_;  ///< what the wheels have turned more than they moved the base
  kinematics::Twist wanted_ = kinematics::Twist::Zero();
  double wanted_s_ = 0.0;
  std::uint64_t commands_ = 0;
  std::deque<std::pair<double, Wheels>> pending_;  ///< commands and when the motors hear of them
  Wheels targets_;
  double time_s_ = 0.0;
};

}  // namespace stereo_nav::sim
