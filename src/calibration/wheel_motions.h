#pragma once

#include <string>
#include <vector>

#include "calibration/wheel_windows.h"

namespace stereo_nav::calibration {

/// What was driven, by the reference.
struct WheelMotions {
  double ahead_m = 0.0;     ///< forward and back
  double sideways_m = 0.0;  ///< left and right
  double left_turns = 0.0;
  double right_turns = 0.0;
};

WheelMotions motionsOf(const std::vector<WheelRun>& runs);

/// What a calibration of this drive needs and these motions lack, with a course that has it; empty if
/// nothing.
std::string missingMotions(const WheelMotions& motions, const kinematics::Drive& drive);

}  // namespace stereo_nav::calibration
