#include "ros/usable_stamps.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/statistics.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {

void keepUsableStamps(const std::string& topic, std::vector<ros::Time>& stamps,
                      std::vector<std::string>& notes) {
  std::sort(stamps.begin(), stamps.end());
  const auto first = std::upper_bound(stamps.begin(), stamps.end(), ros::Time());
  const auto zero = first - stamps.begin();
  stamps.erase(stamps.begin(), first);
  if (stamps.empty()) {
    throw InputError(topic +
                     ": all images have the stamp 0; the driver does not stamp them: record with one "
                     "that sets header.stamp to the time of exposure");
  }
  if (zero > 0) {
    notes.push_back(topic + ": images with the stamp 0 are left out: " + std::to_string(zero) +
                    "; the driver did not stamp them");
  }
  const auto last = std::unique(stamps.begin(), stamps.end());
  const auto repeated = stamps.end() - last;
  stamps.erase(last, stamps.end());
  if (repeated > 0) {
    notes.push_back(topic +
                    ": images whose stamp an earlier one has are left out: " + std::to_string(repeated));
  }
}

void notePauses(const std::vector<double>& times_s, std::vector<std::string>& notes) {
  constexpr double kPause_s = 1.0;
  std::vector<double> periods_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) periods_s.push_back(times_s[i] - times_s[i - 1]);
  if (periods_s.empty()) return;
  std::vector<double> sorted_s = periods_s;
  const double least_s = std::max(kPause_s, 3.0 * upperMedian(sorted_s));
  for (std::size_t i = 0; i < periods_s.size(); ++i) {
    if (periods_s[i] <= least_s) continue;
    notes.push_back(fmt::format(
        "a gap of {:.1f} s without images after t = {:.3f} s: the recording paused, or the clock of the computer was set; what "
        "moved meanwhile is missing, and stretches recorded with the clock set back may lie in another order",
        periods_s[i], times_s[i]));
  }
}

}  // namespace stereo_nav::ros_io
