#pragma once

// Compiled by host and controller, see protocol.h.

#include "protocol.h"

namespace stereo_nav {
namespace base {

/// Since the parser was made.
struct ParserCounters {
  uint32_t bytes;          ///< received
  uint32_t bytes_skipped;  ///< outside of good frames
  uint32_t delivered;
  uint32_t bad_crc;     ///< the beginning of a frame was found, but its check sum is wrong
  uint32_t impossible;  ///< the check sum is right, but the counts contradict the length
  uint32_t lost;        ///< gaps in the sequence
  uint32_t stale;       ///< repeated, or older than one that was delivered
};

/// Finds the frames of one kind of message in a byte stream. After damage it continues the search at the byte
/// behind the false beginning, so that no intact frame is lost. A frame that comes again, or after a later
/// one, is dropped. Fixed buffer, no allocation, bounded work per byte.
template <class Message, class Crc>
class FrameParser {
 public:
  /// Returns whether `message` was filled: with the last byte of a frame, or up to one frame later when a
  /// false beginning hid it. Not more than one message a byte: a second one follows with the next byte.
  bool push(uint8_t byte, Message& message) {
    buffer_[size_++] = byte;
    ++counters_.bytes;
    while (true) {
      while (size_ > 0 && !prefixAtFront()) skip();
      if (size_ < kPrefixBytes) return false;
      const size_t frame_bytes = kPrefixBytes + buffer_[3] + kCrcBytes;
      if (size_ < frame_bytes) return false;
      if (take(frame_bytes, message)) return true;
    }
  }

  /// Forgets a partly received frame and the sequence: a port that was opened again, or a sender that may
  /// have been restarted.
  void reset() {
    size_ = 0;
    forgetSequence();
  }
  void forgetSequence() { knows_sequence_ = false; }

  const ParserCounters& counters() const { return counters_; }
  /// Bytes that were received behind the frame that push() delivered last.
  size_t pending() const { return size_; }

 private:
  /// A frame this much older than the last one is late; one that is older still comes from a sender that
  /// began again.
  static constexpr uint16_t kLateFrames = 50;
  /// A larger gap means that the sender began again.
  static constexpr uint16_t kRestartGap = 10000;

  bool prefixAtFront() const {
    if (buffer_[0] != kSync0) return false;
    if (size_ > 1 && buffer_[1] != kSync1) return false;
    if (size_ > 2 && buffer_[2] != Message::kType) return false;
    return size_ <= 3 || (buffer_[3] >= Message::kMinPayload && buffer_[3] <= Message::kMaxPayload);
  }

  bool take(size_t frame_bytes, Message& message) {
    const size_t payload = frame_bytes - kPrefixBytes - kCrcBytes;
    uint32_t sent_crc = 0;
    ByteReader(&buffer_[kPrefixBytes + payload]).u32(sent_crc);
    if (Crc::of(&buffer_[2], 2 + payload) != sent_crc) {
      ++counters_.bad_crc;
      skip();
      return false;
    }
    Message read = Message();
    ByteReader reader(&buffer_[kPrefixBytes]);
    Layout<ByteReader, Message>::counts(reader, read);
    if (!countsFit(read) || payloadBytes(read) != payload) {
      ++counters_.impossible;
      drop(frame_bytes);
      return false;
    }
    Layout<ByteReader, Message>::lists(reader, read);
    drop(frame_bytes);
    if (!isNew(read.sequence)) return false;
    message = read;
    ++counters_.delivered;
    return true;
  }

  bool isNew(uint16_t sequence) {
    const uint16_t ahead = static_cast<uint16_t>(sequence - last_sequence_);
    const uint16_t behind = static_cast<uint16_t>(last_sequence_ - sequence);
    if (knows_sequence_ && behind < kLateFrames) {
      ++counters_.stale;
      return false;
    }
    if (knows_sequence_ && ahead < kRestartGap) counters_.lost += ahead - 1U;
    knows_sequence_ = true;
    last_sequence_ = sequence;
    return true;
  }

  void skip() {
    ++counters_.bytes_skipped;
    drop(1);
  }

  void drop(size_t count) {
    size_ -= count;
    memmove(buffer_, buffer_ + count, size_);
  }

  uint8_t buffer_[maxFrameBytes<Message>()] = {};
  size_t size_ = 0;
  bool knows_sequence_ = false;
  uint16_t last_sequence_ = 0;
  ParserCounters counters_ = ParserCounters();
};

}  // namespace base
}  // namespace stereo_nav
