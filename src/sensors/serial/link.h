#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "sensors/serial/byte_source.h"
#include "sensors/serial/link_monitor.h"
#include "sensors/serial/serial_port.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::serial {

struct LinkParams {
  double retry_s = 0.5;
  double reopen_silent_s = 5.0;

  void describe(ParameterVisitor& visitor);
};

/// A snapshot for diagnostics.
struct LinkStatus {
  LinkState state = LinkState::kDisconnected;
  double silent_s = 0.0;          ///< since the last byte; 0 while disconnected
  std::string fault;              ///< why it was disconnected last: what was seen, likely cause, remedy
  std::uint64_t connections = 0;  ///< how often the device appeared
};

/// Keeps a device open that may appear, disappear and fall silent. Faults never throw: they are reported by
/// status(), the device is opened again every `retry_s`, and a silent one is opened anew, which some adapters
/// need.
class Link {
 public:
  /// Opens the device and throws SerialError where that fails. Called in the thread of read(), at each
  /// opening: the place to reset a decoder, and to keep a weak_ptr of a port that is also written to.
  using Open = std::function<std::shared_ptr<ByteSource>()>;

  Link(const LinkParams& params, Open open) : params_(params), open_(std::move(open)) {}

  /// Waits for bytes for at most `timeout_s`, opening the device when it is time to, and returns how many
  /// were read. To be called from one thread in a loop.
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s);
  /// Tells that the bytes contained a frame.
  void delivered();
  /// Closes the device because of a fault that the caller has met, e.g. when writing.
  void disconnect(const SerialError& error);
  /// May be called from any thread.
  LinkStatus status() const;

 private:
  void tryOpen(double now_s);

  LinkParams params_;
  Open open_;
  std::shared_ptr<ByteSource> source_;
  double next_attempt_s_ = 0.0;

  mutable std::mutex mutex_;  ///< guards what follows
  LinkMonitor monitor_;
  std::string fault_;
  std::uint64_t connections_ = 0;
};

}  // namespace stereo_nav::serial
