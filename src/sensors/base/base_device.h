#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "sensors/base/telemetry_decoder.h"
#include "sensors/serial/frame_link.h"
#include "sensors/serial/port_finder.h"

namespace stereo_nav::base {

struct BaseDeviceParams {
  int baud_rate = 500000;
  double latency_s = 0.0;
  serial::LinkParams link;
  serial::StampFilterParams stamps;

  void describe(ParameterVisitor& visitor);
};

/// Telemetry with its time.
struct BaseReading {
  double time_s = 0.0;     ///< when the counters were read, on the steady clock
  double arrival_s = 0.0;  ///< when it arrived, on the same clock
  Telemetry telemetry{};
};

/// A snapshot for diagnostics.
struct BaseDeviceStatus : serial::DeviceStatus {
  std::uint64_t commands_sent = 0;
  std::uint64_t commands_unsent = 0;  ///< made while the port was not open, or could not be written to
  ParserCounters counters{};
};

/// The microcontroller of a base on a serial port that may appear, disappear and fall silent. Faults of the
/// line never throw: the device reports them, tries again, and resumes.
class BaseDevice {
 public:
  using Sink = std::function<void(const BaseReading&)>;

  BaseDevice(const BaseDeviceParams& params, serial::PortFinder port);

  /// Waits for bytes for at most `timeout_s` and passes on the readings that they complete. To be called from
  /// one thread in a loop, as is send().
  void poll(double timeout_s, const Sink& sink);
  /// Sends a command, whose sequence number the caller counts. Where the port is not open it is dropped and
  /// counted: an old command is of no use.
  void send(const Command& command);
  /// May be called from any thread.
  BaseDeviceStatus status() const;

 private:
  std::shared_ptr<serial::ByteSource> open();
  void deliver(const DecodedTelemetry& frame, const Sink& sink);
  serial::LinkWords words() const;

  BaseDeviceParams params_;
  serial::PortFinder finder_;
  TelemetryDecoder decoder_;
  std::weak_ptr<serial::SerialPort> port_;
  serial::FrameLink link_;

  mutable std::mutex mutex_;  ///< guards what follows
  BaseDeviceStatus status_;
};

}  // namespace stereo_nav::base
