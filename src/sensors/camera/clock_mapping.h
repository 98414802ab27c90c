#pragma once

#include <cstdint>
#include <functional>

namespace stereo_nav::camera {

/// Carries times of the monotonic clock into ROS time by their offset. The offset is measured anew again and
/// again, since ROS time (the system's clock) is slewed and stepped by NTP and the monotonic clock is not. A
/// carried time never depends on when it is carried, only on the offset.
class ClockMapping {
 public:
  using Clock = std::function<std::int64_t()>;  ///< nanoseconds

  ClockMapping(Clock monotonic, Clock ros);

  /// Reads ROS time between two readings of the monotonic clock, several times, and keeps the narrowest: the
  /// offset is then known to half the time between the two. Returns by how much the offset changed, ns.
  std::int64_t measure();

  std::int64_t toRos(std::int64_t monotonic_ns) const { return monotonic_ns + offset_ns_; }
  std::int64_t offset_ns() const { return offset_ns_; }

 private:
  std::int64_t readOffset() const;

  Clock monotonic_;
  Clock ros_;
  std::int64_t offset_ns_;
};

}  // namespace stereo_nav::camera
