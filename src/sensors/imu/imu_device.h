#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sensors/imu/frame_decoder.h"
#include "sensors/imu/udp_source.h"
#include "sensors/serial/frame_link.h"
#include "sensors/serial/port_finder.h"

namespace stereo_nav::imu {

struct ImuDeviceParams {
  Protocol protocol = Protocol::kAngles;
  int baud_rate = 115200;
  AngleOrder angle_order = AngleOrder::kYawPitchRoll;
  double latency_s = 0.0;
  serial::LinkParams link;
  AngleGateParams gate;
  serial::StampFilterParams stamps;

  void describe(ParameterVisitor& visitor);
};

/// One measurement of the module with its time.
struct ImuReading {
  double time_s = 0.0;  ///< when it was taken, on the steady clock
  std::optional<ModuleAngles> angles;
  std::optional<RawMeasurement> raw;
};

/// A snapshot for diagnostics.
struct ImuDeviceStatus : serial::DeviceStatus {
  DecoderCounters counters;
};

/// A module on a serial port, or one that sends UDP, that may appear, disappear and fall silent. Faults of
/// the line never throw: the device reports them, retries every `retry_s`, and resumes.
class ImuDevice {
 public:
  using Sink = std::function<void(const ImuReading&)>;

  /// `port`: serial port, or what parseUdpAddress() takes. Throws ParameterError where protocol and port do
  /// not go together.
  ImuDevice(const ImuDeviceParams& params, serial::PortFinder port);

  /// Waits for bytes for at most `timeout_s` and passes on the readings that they complete. To be called from
  /// one thread in a loop.
  void poll(double timeout_s, const Sink& sink);
  /// May be called from any thread.
  ImuDeviceStatus status() const;

 private:
  std::shared_ptr<serial::ByteSource> open();
  void deliver(const DecodedFrame& frame, const Sink& sink);
  serial::LinkWords words() const;
  serial::LinkWords wordsOfUdp() const;

  ImuDeviceParams params_;
  serial::PortFinder finder_;
  std::optional<UdpAddress> udp_;  ///< nothing: a serial port
  std::unique_ptr<FrameDecoder> decoder_;
  serial::FrameLink link_;

  mutable std::mutex mutex_;  ///< guards what follows
  DecoderCounters counters_;
};

}  // namespace stereo_nav::imu
