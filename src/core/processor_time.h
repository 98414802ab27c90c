#pragma once

#include <ctime>

namespace stereo_nav {

/// Processor time of this thread, ms: what work costs, whatever else the machine does.
inline double processorTime_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace stereo_nav
