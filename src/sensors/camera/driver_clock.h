#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sensors/camera/kernel.h"
#include "sensors/camera/v4l2_device.h"

namespace stereo_nav::camera {

/// Which moment of the monotonic clock a buffer's stamp stands for. Drivers promise CLOCK_MONOTONIC by a
/// flag; without it the clock is recognised from the first frame: monotonic or real time when the stamp is
/// close to that clock's "now", and otherwise unusable, so that the time of dequeuing stands in.
class DriverClock {
 public:
  enum class Kind { Monotonic, RealTime, Unusable };

  explicit DriverClock(Kernel& kernel) : kernel_(kernel) {}

  /// To be called when streaming starts: the next frame decides anew.
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

/// The middle of the exposure of the middle row: stamps are taken when the first row's begins or when the
/// frame ends (V4L2's flags say which). What is not known, exposure or rolling shutter, is left out.
std::int64_t middleOfExposure(std::int64_t stamp_ns, std::uint32_t buffer_flags,
                              std::optional<double> exposure_s, double rolling_shutter_s);

}  // namespace stereo_nav::camera
