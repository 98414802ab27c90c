#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sensors/imu/module_angles.h"

namespace stereo_nav::imu {

/// The thesis names the three floats yaw, pitch, roll in its program and roll, pitch, yaw in its text.
enum class AngleOrder { kYawPitchRoll, kRollPitchYaw };

/// Fifteen bytes that look like a frame; AngleGate decides whether they are one.
struct AngleCandidate {
  ModuleAngles angles;
  std::uint64_t first_byte = 0;  ///< position in the stream, from 0
  bool follows = false;          ///< the previous candidate ended directly before this one
};

/// Since the start of the stream.
struct AngleFramerCounters {
  std::uint64_t bytes = 0;
  std::uint64_t bytes_skipped = 0;  ///< skipped while looking for a header
  std::uint64_t impossible = 0;     ///< header found, but NaN, infinity or an angle no module sends
};

/// Finds frames of the thesis' angle module in a byte stream: `its`, then three little-endian IEEE-754
/// floats, degrees, no checksum.
///
/// `its` also occurs inside floats. A frame taken 4, 8 or 12 bytes off, or after one to three lost bytes, has
/// `i`, `t` or `s` of the true header as the most significant byte of one of its floats, which makes that
/// float at least 1e25: the range check alone settles those cases. Any other false header fails because no
/// header follows at the right distance: a candidate whose successor is missing is searched again from its
/// second byte on.
///
/// Works on a fixed buffer: no allocation, no read beyond it, bounded work per byte.
class AngleFramer {
 public:
  static constexpr std::size_t kHeaderBytes = 3;
  static constexpr std::size_t kFrameBytes = 15;

  explicit AngleFramer(AngleOrder order) : order_(order) {}

  /// Returns a candidate with its last byte.
  std::optional<AngleCandidate> push(std::uint8_t byte);
  /// Forgets a partly received frame, e.g. when the port was opened again.
  void reset();
  const AngleFramerCounters& counters() const { return counters_; }

 private:
  bool headerAt(std::size_t offset, std::size_t available) const;
  bool judgeSuccessor();
  void alignToHeader();
  std::optional<AngleCandidate> decode();
  void drop(std::size_t count);

  AngleOrder order_;
  std::array<std::uint8_t, kFrameBytes + kHeaderBytes> buffer_{};
  std::size_t size_ = 0;
  bool front_reported_ =
      false;  ///< the first 15 bytes were returned; their successor's header has not come yet
  std::optional<std::uint64_t> last_first_byte_;
  AngleFramerCounters counters_;
};

/// Writes one frame into `frame` (kFrameBytes bytes).
void encodeAngleFrame(const ModuleAngles& angles, AngleOrder order, std::uint8_t* frame);

}  // namespace stereo_nav::imu
