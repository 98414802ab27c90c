#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sensors/serial/byte_source.h"

namespace stereo_nav::serial {

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

/// A serial port: 8N1, raw, non-blocking, any baud rate, locked against other programs that use
/// locks (flock, TIOCEXCL). Closing does not drop DTR, which would restart an Arduino.
class SerialPort : public ByteSource {
 public:
  /// Throws SerialError. Bytes that came before the opening are discarded.
  SerialPort(const std::string& path, int baud_rate);
  ~SerialPort() override;

  std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) override;
  /// Writes all bytes, waiting for the adapter to take them for at most a second. Throws SerialError (kLost)
  /// when it does not, or has disappeared.
  void write(const std::uint8_t* bytes, std::size_t size);
  /// Sets the line DTR. A port without modem lines, such as a pseudo-terminal, ignores it.
  void setDtr(bool on);
  const std::string& path() const { return path_; }

 private:
  void lock();
  void configure(int baud_rate);

  std::string path_;
  int fd_ = -1;
};

}  // namespace stereo_nav::serial
