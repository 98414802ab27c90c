#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sensors/serial/byte_source.h"

namespace stereo_nav::imu {

/// Where datagrams are received.
struct UdpAddress {
  std::string host = "127.0.0.1";  ///< IPv4 address of this computer; 0.0.0.0: all it has
  std::uint16_t port = 0;

  std::string text() const { return host + ":" + std::to_string(port); }
};

/// Reads `udp:PORT`, which is heard on loopback only, or `udp:ADDRESS:PORT`; nothing where the text does not
/// begin with `udp:`. Throws ParameterError where it does and is neither.
std::optional<UdpAddress> parseUdpAddress(const std::string& text);

/// A UDP socket that receives: each read() returns one datagram.
class UdpSource : public serial::ByteSource {
 public:
  /// Throws serial::SerialError.
  explicit UdpSource(const UdpAddress& address);
  ~UdpSource() override;

  std::size_t read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) override;

 private:
  UdpAddress address_;
  int fd_ = -1;
};

}  // namespace stereo_nav::imu
