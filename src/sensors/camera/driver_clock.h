#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sensors/camera/kernel.h"
#include "sensors/camera/v4l2_device.h"

namespace stereo_nav::camera {

/// Converts the stamps of buffers to the monotonic clock. Drivers announce CLOCK_MONOTONIC by a flag. Without
/// the flag the clock is recognised from the first frame: it is the monotonic or the real-time clock if the
/// stamp is close to that clock's present time. Otherwise the stamps are unusable, and the time of dequeuing
/// is used instead.
class DriverClock {
 public:
  enum class Kind { kMonotonic, kRealTime, kUnusable };

  explicit DriverClock(Kernel& kernel) : kernel_(kernel) {}

  /// To be called when streaming starts: the clock is recognised again from the next frame.
  void reset() { kind_.reset(); }

  /// The stamp in CLOCK_MONOTONIC, nanoseconds.
  std::int64_t monotonicStamp(const LentBuffer& buffer);

  std::optional<Kind> kind() const { return kind_; }
  /// What is doubtful about the stamps; empty when nothing is.
  const std::string& warning() const { return warning_; }

 private:
  void recognise(const LentBuffer& buffer);

  Kernel& kernel_;
  std::optional<Kind> kind_;
  std::string warning_;
};

/// The middle of the exposure of the middle row. The stamp is taken when the exposure of the first row begins
/// or when the frame ends; V4L2's flags say which. If the exposure time or the readout time is unknown, its
/// correction is left out.
std::int64_t middleOfExposure(std::int64_t stamp_ns, std::uint32_t buffer_flags,
                              std::optional<double> exposure_s, double rolling_shutter_s);

}  // namespace stereo_nav::camera
