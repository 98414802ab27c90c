#include "sensors/camera/driver_clock.h"

#include <linux/videodev2.h>

#include <cmath>
#include <cstdlib>

namespace stereo_nav::camera {
namespace {

/// A stamp this close to a clock's present time belongs to that clock.
constexpr std::int64_t kClose_ns = 10'000'000'000;

}  // namespace

std::int64_t DriverClock::monotonicStamp(const LentBuffer& buffer) {
  if (!kind_) recognise(buffer);
  switch (*kind_) {
    case Kind::kMonotonic:
      return buffer.stamp_ns;
    case Kind::kRealTime:
      return buffer.stamp_ns - (kernel_.realtimeNow() - kernel_.monotonicNow());
    case Kind::kUnusable:
      return buffer.dequeued_ns;
  }
  return buffer.dequeued_ns;
}

void DriverClock::recognise(const LentBuffer& buffer) {
  warning_.clear();
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    kind_ = Kind::kMonotonic;
  } else if (std::abs(buffer.stamp_ns - buffer.dequeued_ns) < kClose_ns) {
    kind_ = Kind::kMonotonic;
    warning_ =
        "the driver does not say to which clock its time stamps belong; they look like the monotonic clock "
        "and are used as such";
  } else if (std::abs(buffer.stamp_ns - kernel_.realtimeNow()) < kClose_ns) {
    kind_ = Kind::kRealTime;
    warning_ =
        "the driver stamps with the system's real time instead of the monotonic clock; stamps may jump when "
        "the clock is set";
  } else {
    kind_ = Kind::kUnusable;
    warning_ =
        "the driver's time stamps belong to no known clock; the time at which frames are taken from the "
        "driver is used instead, which is late and jitters: expect worse pairs";
  }
}

std::int64_t middleOfExposure(std::int64_t stamp_ns, std::uint32_t buffer_flags,
                              std::optional<double> exposure_s, double rolling_shutter_s) {
  const double frame_s = exposure_s.value_or(0.0) + rolling_shutter_s;
  const auto half_ns = static_cast<std::int64_t>(std::llround(frame_s * 0.5e9));
  const bool start = (buffer_flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return start ? stamp_ns + half_ns : stamp_ns - half_ns;
}

}  // namespace stereo_nav::camera
