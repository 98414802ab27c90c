#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace stereo_nav::range {

/// One measurement of a TFmini, as it was sent.
struct TfminiMeasurement {
  std::uint16_t distance_cm = 0;
  std::uint16_t strength = 0;     ///< of the returned light
  std::uint16_t temperature = 0;  ///< TFmini Plus and TFmini-S: of the chip, in 1/8 degree from -256 on
};

/// A frame that TfminiParser has accepted.
struct TfminiFrame {
  TfminiMeasurement measurement;
  std::uint64_t index = 0;      ///< number of frames sent since the first one, lost ones included
  std::uint64_t last_byte = 0;  ///< position in the stream of the frame's last byte, from 0
};

/// Since the start of the stream.
struct TfminiCounters {
  std::uint64_t bytes = 0;
  std::uint64_t bytes_skipped = 0;  ///< outside of good frames
  std::uint64_t frames = 0;         ///< delivered
  std::uint64_t bad_frames = 0;     ///< header found, but the check sum is wrong or the distance impossible
  std::uint64_t lost = 0;           ///< frames that were sent and not delivered, by the bytes in between
};

/// The frames of Benewake's TFmini, TFmini-S and TFmini Plus, in their standard format: 0x59 0x59, distance,
/// strength and temperature (the first TFmini: mode) as 16-bit numbers, little-endian, and the sum of the
/// eight bytes.
namespace tfmini {
constexpr std::size_t kFrameBytes = 9;
constexpr std::size_t kHeaderBytes = 2;
/// Farthest of the family, TFmini-S with slack; distances from kFirstCode on are codes for failures.
constexpr std::uint16_t kMaxDistance_cm = 2200;
constexpr std::uint16_t kFirstCode = 65532;

void encode(const TfminiMeasurement& measurement, std::uint8_t* frame);
}  // namespace tfmini

/// Finds frames in a byte stream. A check sum of eight bits lets one in 256 false frames through, so that a
/// frame also needs a neighbour: it begins directly behind the one before, or a header stands directly behind
/// it. After damage the search goes on at the byte behind the false beginning. Works on a fixed buffer: no
/// allocation, no read beyond it, bounded work per byte.
class TfminiParser {
 public:
  /// Returns a frame with its last byte, or two bytes later when it has no neighbour before it.
  std::optional<TfminiFrame> push(std::uint8_t byte);
  /// Forgets a partly received frame, e.g. when the port was opened again.
  void reset();
  const TfminiCounters& counters() const { return counters_; }

 private:
  bool headerAt(std::size_t offset) const;
  bool good() const;
  TfminiFrame take();
  void dropByte();

  std::array<std::uint8_t, tfmini::kFrameBytes + tfmini::kHeaderBytes> buffer_{};
  std::size_t size_ = 0;
  bool first_ = true;        ///< no frame has been delivered since the stream began
  std::size_t skipped_ = 0;  ///< bytes since the last frame
  std::uint64_t index_ = 0;
  TfminiCounters counters_;
};

}  // namespace stereo_nav::range
