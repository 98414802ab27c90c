#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

namespace stereo_nav::serial {

/// Corrupts and loses bytes at random; the same seed gives the same faults.
class LineFaults {
 public:
  LineFaults(double corrupt_probability, double drop_probability, unsigned seed)
      : corrupt_probability_(corrupt_probability), drop_probability_(drop_probability), random_(seed) {}

  /// Appends to `out` the bytes that come through. Returns whether all of them did, unchanged.
  bool pass(const std::uint8_t* bytes, std::size_t size, std::vector<std::uint8_t>& out);

 private:
  double corrupt_probability_, drop_probability_;
  std::mt19937 random_;
};

/// A serial line and the USB adapter at its end: each byte takes ten bit times, one after the other, and the
/// bytes are handed over in batches at multiples of `batch_s` (0: as they come).
class SerialLine {
 public:
  SerialLine(int baud_rate, double batch_s) : byte_time_s_(10.0 / baud_rate), batch_s_(batch_s) {}

  /// Begins to send at `time_s`, or later when the line becomes free.
  void send(const std::vector<std::uint8_t>& bytes, double time_s);
  /// How long a byte given to the line at `time_s` would have to wait.
  double backlog_s(double time_s) const;
  /// Appends what the adapter has handed over by `time_s`.
  void collect(double time_s, std::vector<std::uint8_t>& out);

 private:
  struct Byte {
    double arrival_s;
    std::uint8_t value;
  };
  double byte_time_s_, batch_s_;
  double free_s_ = 0.0;
  std::deque<Byte> bytes_;
};

/// What a receiver at another baud rate reads: it samples the levels of the line in the middle of its own
/// bits. A missing stop bit gives a zero byte, as the kernel delivers it.
class MismatchedReceiver {
 public:
  MismatchedReceiver(int sender_baud, int receiver_baud)
      : receiver_bit_(static_cast<double>(sender_baud) / receiver_baud) {}

  /// Bytes follow each other without a pause. Appends what the receiver delivers.
  void receive(const std::vector<std::uint8_t>& bytes, std::vector<std::uint8_t>& out);

 private:
  bool level(double bit_time) const;
  bool known(double bit_time) const { return bit_time < static_cast<double>(levels_.size()); }

  double receiver_bit_;      ///< length of the receiver's bit, in bits of the sender
  std::deque<bool> levels_;  ///< sender's bits not consumed yet
  double position_ = 0.0;    ///< in sender's bits, from the front of `levels_`
};

}  // namespace stereo_nav::serial
