#pragma once

#include <string>
#include <vector>

#include "kinematics/drive_params.h"
#include "odometry/wheel/wheel_odometry.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::ros_io {

/// A reading in the order of the drive's wheels, without the yaw. Throws InputError where names, counters or
/// angles are not those of this drive, or hold a NaN.
odometry::WheelSample toWheelSample(const WheelTicks& message, const kinematics::DriveParams& drive);

}  // namespace stereo_nav::ros_io
