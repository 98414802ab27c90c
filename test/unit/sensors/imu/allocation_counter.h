#pragma once

#include <cstddef>

namespace stereo_nav::imu {

/// How often operator new was called in this program.
std::size_t allocationCount();

}  // namespace stereo_nav::imu
