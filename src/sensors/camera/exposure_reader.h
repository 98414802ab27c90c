#pragma once

#include <cstdint>
#include <optional>

#include "sensors/camera/device_controls.h"

namespace stereo_nav::camera {

/// Exposure and gain in use. Absent where the camera has no such control or does not tell its value.
struct ExposureReading {
  std::optional<std::int32_t> exposure;  ///< control exposure_time_absolute, 100 us
  std::optional<std::int32_t> gain;
  bool untold = false;  ///< automatic, and the camera does not tell which time it chose

  std::optional<double> exposure_s() const;
};

/// Reads which exposure a camera uses, and decides whether what it tells is to be believed: in automatic
/// modes many cameras report the last manual value.
class ExposureReader {
 public:
  ExposureReading read(DeviceControls& controls);
  /// After the camera was opened or a control was set: what changes now does not change by itself.
  void forgetLast() { automatic_exposure_.reset(); }

 private:
  bool isTold(DeviceControls& controls, std::int32_t exposure);

  std::optional<std::int32_t> automatic_exposure_;  ///< read last
  bool changes_by_itself_ = false;
};

}  // namespace stereo_nav::camera
