#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace stereo_nav::imu {

/// One measurement of a raw module, in its own axes (front-left-up when mounted as documented).
struct RawMeasurement {
  std::uint16_t sequence = 0;                     ///< counts frames sent, wraps
  std::uint32_t device_time_us = 0;               ///< the module's clock, wraps every 71.6 minutes
  Eigen::Vector3d angular_velocity;               ///< rad/s
  Eigen::Vector3d linear_acceleration;            ///< specific force, m/s^2; +9.81 upwards at rest
  std::optional<Eigen::Vector3d> magnetic_field;  ///< microtesla
};

/// A frame whose check sum is good.
struct RawFrame {
  RawMeasurement measurement;   ///< what the frame says
  std::uint64_t last_byte = 0;  ///< position in the stream of the frame's last byte, from 0
};

/// Since the start of the stream.
struct RawParserCounters {
  std::uint64_t bytes = 0;          ///< received
  std::uint64_t bytes_skipped = 0;  ///< outside of good frames
  std::uint64_t delivered = 0;      ///< good frames
  std::uint64_t bad_crc = 0;        ///< the beginning of a frame was found, but its check sum is wrong
  std::uint64_t impossible = 0;     ///< the check sum is right, but no such sensor measures these values
  std::uint64_t lost = 0;           ///< gaps in the sequence numbers
};

/// The raw protocol, all numbers little-endian:
///
/// | bytes | content |
/// |---|---|
/// | 2 | 0xA5 0x5A |
/// | 1 | type: 1 gyroscope + accelerometer, 2 the same + magnetometer |
/// | 1 | length n of the payload: 30 for type 1, 42 for type 2 |
/// | n | uint16 sequence, uint32 time in us, float32[3] gyroscope rad/s, float32[3] accelerometer m/s^2, for
///       type 2 float32[3] magnetometer uT |
/// | 4 | CRC-32 (IEEE 802.3, as zlib's) of type, length and payload |
///
/// A check sum of 32 bits, because 16 would let about one in 65536 damaged frames through: four in a million
/// frames on a line that corrupts one byte in a hundred.
namespace raw_protocol {
constexpr std::size_t kPrefixBytes = 4;                                        ///< before the payload
constexpr std::size_t kCrcBytes = 4;                                           ///< behind the payload
constexpr std::size_t kPayloadBytes = 30;                                      ///< of type 1
constexpr std::size_t kPayloadBytesWithMagnetometer = 42;                      ///< of type 2
constexpr std::size_t kFrameBytes = kPrefixBytes + kPayloadBytes + kCrcBytes;  ///< a whole frame of type 1
constexpr std::size_t kMaxFrameBytes =
    kPrefixBytes + kPayloadBytesWithMagnetometer + kCrcBytes;  ///< a whole frame of type 2

/// Writes a frame (at most kMaxFrameBytes) and returns its length.
std::size_t encode(const RawMeasurement& measurement, std::uint8_t* frame);
/// Whether a module of this class can measure these values: finite, up to 4000 deg/s, 32 g, 100 times the
/// earth's field.
bool possible(const RawMeasurement& measurement);
}  // namespace raw_protocol

/// Finds raw frames in a byte stream. After damage it continues the search at the byte behind the false
/// beginning, so that no intact frame is lost. It works on a fixed buffer: no allocation, no read beyond it,
/// bounded work per byte.
class RawParser {
 public:
  /// Returns a frame with its last byte, or up to one frame later when a false beginning hid it.
  std::optional<RawFrame> push(std::uint8_t byte);
  /// Forgets a partly received frame and the sequence, e.g. when the port was opened again.
  void reset();
  /// What was received so far.
  const RawParserCounters& counters() const { return counters_; }

 private:
  void alignToPrefix();
  bool prefixAtFront() const;
  std::optional<RawFrame> takeFrame(std::size_t frame_bytes);
  void countLost(std::uint16_t sequence);
  void skip();
  void drop(std::size_t count);

  std::array<std::uint8_t, raw_protocol::kMaxFrameBytes> buffer_{};
  std::size_t size_ = 0;
  std::optional<std::uint16_t> last_sequence_;
  RawParserCounters counters_;
};

}  // namespace stereo_nav::imu
