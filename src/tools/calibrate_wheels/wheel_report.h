#pragma once

#include "calibration/wheel_calibration.h"

namespace stereo_nav::tools {

/// Prints what was driven, what was found of each wheel, and how well wheels and reference agree.
void printCalibration(const calibration::WheelCalibration& found, const kinematics::DriveParams& nominal,
                      const calibration::WheelCalibrationParams& params);

}  // namespace stereo_nav::tools
