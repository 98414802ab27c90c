#include "stereo_nav/ros/recorded_clock.h"

#include <algorithm>

namespace stereo_nav::ros_io {

std::vector<std::size_t> clockJumps(const std::vector<ros::Time>& stamps) {
  const ros::Duration least(0.25);
  constexpr std::size_t kConfirming = 3;
  std::vector<std::size_t> jumps;
  ros::Time before;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i].isZero()) continue;
    const auto end = stamps.begin() + static_cast<std::ptrdiff_t>(std::min(i + kConfirming, stamps.size()));
    const bool follows_early_one = i >= 2 && stamps[i - 2] < stamps[i];
    const bool stays = before - stamps[i] > least && !follows_early_one &&
                       std::all_of(stamps.begin() + static_cast<std::ptrdiff_t>(i), end,
                                   [&](const ros::Time& stamp) { return stamp < before; });
    if (!before.isZero() && stays) jumps.push_back(i);
    before = stays || follows_early_one ? stamps[i] : std::max(before, stamps[i]);
  }
  return jumps;
}

RecordedClock::RecordedClock(const std::vector<ReceivedStamp>& images) {
  std::vector<ros::Time> stamps;
  for (const ReceivedStamp& image : images) stamps.push_back(image.stamp);
  ros::Duration offset(0.0);
  for (const std::size_t jump : clockJumps(stamps)) {
    const ros::Duration passed = images[jump].received - images[jump - 1].received;
    offset += passed - (images[jump].stamp - images[jump - 1].stamp);
    offsets_.push_back(offset);
    begins_s_.push_back((images[jump].stamp + offset).toSec());
  }
}

void RecordedClock::straighten(std::vector<ros::Time>& stamps) const {
  if (offsets_.empty()) return;
  std::vector<std::size_t> jumps = clockJumps(stamps);
  jumps.resize(std::min(jumps.size(), offsets_.size()));
  for (std::size_t k = 0; k < jumps.size(); ++k) {
    const std::size_t end = k + 1 < jumps.size() ? jumps[k + 1] : stamps.size();
    for (std::size_t i = jumps[k]; i < end; ++i) {
      if (!stamps[i].isZero()) stamps[i] += offsets_[k];
    }
  }
}

double RecordedClock::offset_s(double time_s) const {
  const auto stretch =
      std::upper_bound(begins_s_.begin(), begins_s_.end(), time_s + 1e-6) - begins_s_.begin();
  return stretch == 0 ? 0.0 : offsets_[static_cast<std::size_t>(stretch) - 1].toSec();
}

}  // namespace stereo_nav::ros_io
