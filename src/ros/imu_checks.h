#pragma once

#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"

namespace stereo_nav::ros_io {

/// Why no image can have a sample of the IMU: its stamps are 0, or lie before or after those of all images.
/// Empty if some can. `samples` are in order of time, `first_s` and `last_s` the stamps of the first and the
/// last image.
std::string imuStampProblem(const std::vector<ImuSample>& samples, double first_s, double last_s);

/// A sample that is further than this from the frames is not late: it has another clock.
constexpr double kImuOffClock_s = 1.0;

/// The same on a running system: the newest sample lies `ahead_s` after the image, or before it where that is
/// negative.
std::string imuOffClock(double ahead_s);

/// Why an IMU whose messages name this frame cannot be used: nothing tells where it sits.
std::string missingImuFrame(const std::string& frame);

}  // namespace stereo_nav::ros_io
