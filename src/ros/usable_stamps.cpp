#include "ros/usable_stamps.h"

#include <algorithm>

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

}  // namespace stereo_nav::ros_io
