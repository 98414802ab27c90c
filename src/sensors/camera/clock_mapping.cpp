#include "sensors/camera/clock_mapping.h"

#include <limits>
#include <utility>

namespace stereo_nav::camera {

ClockMapping::ClockMapping(Clock monotonic, Clock ros)
    : monotonic_(std::move(monotonic)), ros_(std::move(ros)), offset_ns_(readOffset()) {}

std::int64_t ClockMapping::measure() {
  const std::int64_t before = offset_ns_;
  offset_ns_ = readOffset();
  return offset_ns_ - before;
}

std::int64_t ClockMapping::readOffset() const {
  constexpr int kReadings = 5;
  std::int64_t narrowest = std::numeric_limits<std::int64_t>::max();
  std::int64_t offset = 0;
  for (int reading = 0; reading < kReadings; ++reading) {
    const std::int64_t before = monotonic_();
    const std::int64_t ros = ros_();
    const std::int64_t after = monotonic_();
    if (after - before >= narrowest) continue;
    narrowest = after - before;
    offset = ros - before - (after - before) / 2;
  }
  return offset;
}

}  // namespace stereo_nav::camera
