#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::kinematics {

/// What a wheel lets the ground do under it.
enum class WheelKind {
  kRollers,  ///< omni and mecanum wheels, and dead wheels: free along the rollers' rolling direction
  kFixed,    ///< a plain wheel that is not steered; it does not move sideways
  kSteered,  ///< a plain wheel on a steering axis through its contact point: swerve module, Ackermann front
             ///< wheel
};

/// One wheel in the frame base_link (x forward, y left, z up).
struct WheelParams {
  std::string name = "wheel";
  WheelKind kind = WheelKind::kRollers;
  double x_m = 0.0;
  double y_m = 0.0;
  /// Where the wheel rolls at a steering angle of zero, counterclockwise from x.
  double direction_deg = 0.0;
  /// Direction in which a roller drives the base, counterclockwise from the wheel's own direction: 0 for omni
  /// and dead wheels, +-45 for mecanum wheels.
  double roller_deg = 0.0;
  double radius_m = 0.05;
  /// Steering is possible from minus to plus this angle; 180 and more mean that it turns without end.
  double max_steering_deg = 360.0;
  /// Pulses that the encoder counts in one turn of the wheel, gear and counted edges included.
  double pulses_per_turn = 1024.0;
  bool encoder_reversed = false;  ///< the encoder counts down when the wheel rolls in its direction

  /// Distance that the circumference rolls in one pulse, with the sign of the encoder, in m.
  double metresPerPulse() const;

  void describe(ParameterVisitor& visitor);
};

/// The wheels of a base: the section `drive` of a rig file. Each drive is a list of such wheels; layouts.h
/// makes the usual ones from their few dimensions.
struct DriveParams {
  std::vector<WheelParams> wheels;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::kinematics
