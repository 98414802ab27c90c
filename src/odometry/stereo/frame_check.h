#pragma once

#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// Throws std::invalid_argument that says what is wrong with the sizes, types, stamps or readout time of a
/// frame.
void checkFrame(const StereoFrame& frame, const vision::StereoCalibration& calibration);

/// Throws std::invalid_argument if the left image was not taken after `previous_left_time_s`.
void checkOrder(const StereoFrame& frame, double previous_left_time_s);

}  // namespace stereo_nav::odometry
