#pragma once

#include <cstdint>
#include <functional>

#include "sensors/laser/node_framer.h"
#include "sensors/laser/scan_assembler.h"
#include "sensors/serial/link_monitor.h"
#include "sensors/serial/stamp_filter.h"

namespace stereo_nav::laser {

/// The bytes of a scan in, revolutions with the times of their beams out.
///
/// The device samples at an even rate and numbers nothing: NodeFramer counts its nodes, and StampFilter turns
/// their numbers into the times at which they were sent. A node is sent when it was measured.
class ScanDecoder {
 public:
  /// `latency_s`: age of a node when the device begins to send it.
  ScanDecoder(const ScanParams& scan, const serial::StampFilterParams& stamps, int baud_rate,
              double latency_s);

  /// `read_time_s`: when the bytes were read, on the steady clock. Byte i of `size` must have arrived earlier
  /// by the time that the bytes behind it need on the wire.
  void push(const std::uint8_t* data, std::size_t size, double read_time_s, const ScanAssembler::Sink& sink);
  /// Begins a new stream; the counters keep their values.
  void reset();

  const NodeFramerCounters& counters() const { return framer_.counters(); }
  /// Spread of the nodes' arrivals and stamps since the last call of jitter().restart().
  serial::JitterMeter& jitter() { return jitter_; }

 private:
  NodeFramer framer_;
  serial::StampFilter stamps_;
  ScanAssembler assembler_;
  serial::JitterMeter jitter_;
  double byte_time_s_, latency_s_;
};

}  // namespace stereo_nav::laser
