#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace stereo_nav::camera {

/// The system calls that capturing needs, as an interface, so that tests can imitate a camera with any fault.
/// Calls that fail return -errno; interrupted calls are repeated.
class Kernel {
 public:
  enum class Ready { kNo, kFrame, kError };

  virtual ~Kernel() = default;
  /// Non-blocking, read and write. Returns a descriptor or -errno.
  virtual int open(const std::string& path) = 0;
  virtual void close(int descriptor) = 0;
  /// Returns 0 or -errno.
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  /// Shared mapping of a driver's buffer; nullptr on failure.
  virtual void* map(int descriptor, std::size_t length, std::int64_t offset) = 0;
  virtual void unmap(void* address, std::size_t length) = 0;
  /// Waits for a frame. Returns kError when the driver flags an error, with or without a frame.
  virtual Ready wait(int descriptor, int timeout_ms) = 0;
  /// CLOCK_MONOTONIC in nanoseconds: the clock of the drivers' stamps.
  virtual std::int64_t monotonicNow() = 0;
  /// CLOCK_REALTIME in nanoseconds.
  virtual std::int64_t realtimeNow() = 0;
};

/// The implementation that calls the operating system.
Kernel& linuxKernel();

}  // namespace stereo_nav::camera
