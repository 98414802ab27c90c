#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "sensors/laser/rplidar_session.h"
#include "sensors/laser/scan_decoder.h"
#include "sensors/serial/link.h"
#include "sensors/serial/port_finder.h"
#include "sensors/serial/serial_port.h"

namespace stereo_nav::laser {

struct LaserDeviceParams {
  int baud_rate = 115200;
  double latency_s = 0.0;
  ScanParams scan;
  serial::LinkParams link;
  serial::StampFilterParams stamps;

  void describe(ParameterVisitor& visitor);
};

/// A snapshot for diagnostics.
struct LaserDeviceStatus {
  serial::LinkState state = serial::LinkState::kDisconnected;
  std::string message;   ///< what is seen; when something is wrong, also the likely cause and the remedy
  bool warning = false;  ///< the device streams, and warns
  std::string info;      ///< model, firmware and serial number; empty before they are known
  double sample_rate_hz = 0.0;
  double scan_rate_hz = 0.0;
  double arrival_jitter_s = 0.0;
  std::uint64_t scans = 0;
  std::uint64_t connections = 0;
  NodeFramerCounters counters;
};

/// An RPLiDAR A1 on a serial port that may appear, disappear and fall silent. Faults never throw: the device
/// reports them, retries, and resumes. The motor turns while the device is open; it is stopped at the end.
class LaserDevice {
 public:
  LaserDevice(const LaserDeviceParams& params, serial::PortFinder port);
  ~LaserDevice();
  LaserDevice(const LaserDevice&) = delete;
  LaserDevice& operator=(const LaserDevice&) = delete;

  /// Waits for bytes for at most `timeout_s` and passes on the scans that they complete. To be called from
  /// one thread in a loop.
  void poll(double timeout_s, const ScanAssembler::Sink& sink);
  /// May be called from any thread. Rates and jitter are those of the last full five seconds.
  LaserDeviceStatus status() const;

 private:
  std::shared_ptr<serial::ByteSource> open();
  void write(rplidar::Command command);
  void take(const std::uint8_t* data, std::size_t size, const ScanAssembler::Sink& sink);
  void beginScan();
  void deliver(const Scan& scan, const ScanAssembler::Sink& sink);
  void updateStatus(std::uint64_t nodes_before, double now_s);
  std::string explain(const serial::LinkStatus& link) const;

  LaserDeviceParams params_;
  serial::PortFinder finder_;
  ScanDecoder decoder_;
  std::weak_ptr<serial::SerialPort> port_;
  RplidarSession session_;
  double last_node_s_ = 0.0;
  serial::Link link_;

  mutable std::mutex mutex_;  ///< guards what follows
  LaserDeviceStatus status_;
  std::string problem_;  ///< the session's
};

}  // namespace stereo_nav::laser
