#pragma once

#include <cstdint>
#include <functional>

namespace stereo_nav::camera {

/// Converts times of the monotonic clock into ROS time by the offset between the clocks. The offset is
/// measured repeatedly, since NTP slews and steps ROS time (the system's clock) but not the monotonic clock.
/// The result depends only on the time and the offset, never on the moment of the conversion.
class ClockMapping {
 public:
  using Clock = std::function<std::int64_t()>;  ///< nanoseconds

  ClockMapping(Clock monotonic, Clock ros);

  /// Reads ROS time several times, each time between two readings of the monotonic clock, and keeps the
  /// reading with the narrowest bracket: the offset is then known to half of the bracket. Returns by how much
  /// the offset changed, ns.
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
