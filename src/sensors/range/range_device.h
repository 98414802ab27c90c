#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "sensors/range/tfmini_protocol.h"
#include "sensors/serial/frame_link.h"
#include "sensors/serial/port_finder.h"

namespace stereo_nav::range {

struct RangeDeviceParams {
  int baud_rate = 115200;
  double range_min_m = 0.1;
  double range_max_m = 12.0;
  int min_strength = 100;
  double latency_s = 0.0;
  serial::LinkParams link;
  serial::StampFilterParams stamps;

  void describe(ParameterVisitor& visitor);
};

/// One measurement with its time.
struct RangeReading {
  double time_s = 0.0;   ///< when it was taken, on the steady clock
  double range_m = 0.0;  ///< by REP-117, see rangeOf()
  TfminiMeasurement measurement;
};

/// The distance by REP-117: NaN where the receiver was dazzled or failed, +Inf where too little light came
/// back (nothing within reach) or the distance is beyond range_max_m, -Inf nearer than range_min_m.
double rangeOf(const TfminiMeasurement& measurement, const RangeDeviceParams& params);

/// A snapshot for diagnostics.
struct RangeDeviceStatus : serial::DeviceStatus {
  TfminiCounters counters;
  TfminiMeasurement last;
};

/// A range finder on a serial port that may appear, disappear and fall silent. Faults of the line never
/// throw: the device reports them, retries, and resumes.
class RangeDevice {
 public:
  using Sink = std::function<void(const RangeReading&)>;

  RangeDevice(const RangeDeviceParams& params, serial::PortFinder port);

  /// Waits for bytes for at most `timeout_s` and passes on the readings that they complete. To be called from
  /// one thread in a loop.
  void poll(double timeout_s, const Sink& sink);
  /// May be called from any thread.
  RangeDeviceStatus status() const;

 private:
  std::shared_ptr<serial::ByteSource> open();
  void deliver(const TfminiFrame& frame, double arrival_s, const Sink& sink);
  serial::LinkWords words() const;

  RangeDeviceParams params_;
  serial::PortFinder finder_;
  TfminiParser parser_;
  double last_arrival_s_ = 0.0;
  serial::FrameLink link_;

  mutable std::mutex mutex_;  ///< guards what follows
  RangeDeviceStatus status_;
};

}  // namespace stereo_nav::range
