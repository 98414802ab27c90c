#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace stereo_nav::imu {

enum class PortFault { kMissing, kPermission, kBusy, kNotSerial, kBadBaudRate, kLost, kOther };

/// The message says what was seen, the likely cause and the remedy.
class SerialError : public std::runtime_error {
 public:
  SerialError(PortFault fault, const std::string& message) : std::runtime_error(message), fault_(fault) {}
  PortFault fault() const { return fault_; }

 private:
  PortFault fault_;
};

/// The error to report for a port whose open() failed with `error_number`.
SerialError explainOpenError(const std::string& path, int error_number);

/// A serial port for reading: 8N1, raw, non-blocking, any baud rate, locked against other programs that use
/// locks (flock, TIOCEXCL). Closing does not drop DTR, which would restart an Arduino.
class SerialPort {
 public:
  /// Throws SerialError. Bytes that came before the opening are discarded.
  SerialPort(const std::string& path, int baud_rate);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Waits for bytes for at most `timeout_s` and returns how many were read, 0 when none came. Throws
  /// SerialError (kLost) when the device has disappeared.
  std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s);
  const std::string& path() const { return path_; }

 private:
  void lock();
  void configure(int baud_rate);

  std::string path_;
  int fd_ = -1;
};

}  // namespace stereo_nav::imu
