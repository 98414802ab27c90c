#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/emulation/serial_line.h"

namespace stereo_nav::serial {

/// The time at which something begins and how long it lasts; it never happens unless given.
struct Interval {
  double start_s = -1.0;
  double duration_s = 0.0;
  bool contains(double time_s) const {
    return start_s >= 0.0 && time_s >= start_s && time_s < start_s + duration_s;
  }
};

struct AdapterOptions {
  int baud_rate = 115200;
  double batch_s = 0.016;          ///< interval at which bytes are handed over
  std::vector<std::string> links;  ///< names under which the port appears
  std::string replug_link;         ///< the first name after it was unplugged; empty: the same
  Interval unplug;                 ///< since the start
  double corrupt_probability = 0.0;
  double drop_probability = 0.0;
  double garbage_probability = 0.0;  ///< that what was sent is followed by random bytes
  unsigned seed = 1;
};

/// A USB adapter with its cable: the serial line from the module with its faults, and a pseudo-terminal that
/// appears, disappears, and gives a reader at another baud rate what it would receive. Times are those of the
/// steady clock.
class EmulatedAdapter {
 public:
  /// Plugs it in. Throws std::runtime_error.
  explicit EmulatedAdapter(AdapterOptions options);

  /// The module has been switched on at this time, from which the cable is pulled as scheduled.
  void start(double start_s) { start_s_ = start_s; }
  /// The module begins to send at `time_s`, or later when the line becomes free. Returns whether all bytes
  /// will come through, unchanged.
  bool send(const std::vector<std::uint8_t>& bytes, double time_s);
  /// How long a byte that the module sends at `time_s` would have to wait.
  double backlog_s(double time_s) const { return line_.backlog_s(time_s); }
  /// Hands over what has come by now, to whoever reads at whatever baud rate, and plugs as scheduled.
  void handOver(double now_s);
  /// What the host has written since the last call.
  std::vector<std::uint8_t> received();

  /// Whether the port has been opened at least once since it was plugged in.
  bool opened() const { return terminal_ && terminal_->baudRate().has_value(); }
  /// Bytes that nobody read and that did not fit into the buffers.
  std::uint64_t overrun() const { return overrun_; }

 private:
  void plugIn();
  std::vector<std::uint8_t> asReceived(const std::vector<std::uint8_t>& bytes);

  AdapterOptions options_;
  double start_s_ = 0.0;
  SerialLine line_;
  LineFaults faults_;
  std::mt19937 random_;
  std::unique_ptr<PseudoTerminal> terminal_;
  std::unique_ptr<MismatchedReceiver> receiver_;
  int receiver_baud_ = 0;
  std::vector<std::uint8_t> kernel_buffer_;
  std::uint64_t overrun_ = 0;
};

}  // namespace stereo_nav::serial
