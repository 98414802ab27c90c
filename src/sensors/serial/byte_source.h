#pragma once

#include <cstddef>
#include <cstdint>

namespace stereo_nav::serial {

/// Something open that delivers the bytes of a module.
class ByteSource {
 public:
  ByteSource() = default;
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Waits for bytes for at most `timeout_s` and returns how many were read, 0 when none came. Throws
  /// SerialError (kLost) when the device has disappeared.
  virtual std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) = 0;
};

}  // namespace stereo_nav::serial
