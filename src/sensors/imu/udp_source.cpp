#include "sensors/imu/udp_source.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "sensors/serial/serial_port.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::imu {
namespace {

constexpr const char* kPrefix = "udp:";

serial::SerialError explain(const UdpAddress& address, int error_number) {
  using serial::PortFault;
  const std::string what = "cannot receive UDP on " + address.text() + ": ";
  if (error_number == EADDRINUSE) {
    return {PortFault::kBusy,
            what + "another program does; `ss -lunp` names it. Stop it, or choose another port"};
  }
  if (error_number == EADDRNOTAVAIL) {
    return {PortFault::kMissing,
            what +
                "this computer has no such address (now); `ip address` shows those it has, "
                "0.0.0.0 stands for all"};
  }
  if (error_number == EACCES) {
    return {PortFault::kPermission, what + "ports below 1024 are reserved; choose a higher one"};
  }
  return {PortFault::kOther, what + std::strerror(error_number)};
}

}  // namespace

std::optional<UdpAddress> parseUdpAddress(const std::string& text) {
  if (text.rfind(kPrefix, 0) != 0) return std::nullopt;
  const std::string rest = text.substr(std::strlen(kPrefix));
  const std::size_t colon = rest.find(':');
  UdpAddress address;
  if (colon != std::string::npos) address.host = rest.substr(0, colon);
  const std::string port = colon == std::string::npos ? rest : rest.substr(colon + 1);
  in_addr parsed{};
  const bool digits =
      !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  const int number = digits ? std::stoi(port) : 0;
  if (number < 1 || number > 65535 || inet_pton(AF_INET, address.host.c_str(), &parsed) != 1) {
    throw ParameterError("port: '" + text +
                         "' is no UDP port: udp:5555 is heard on this computer alone, "
                         "udp:0.0.0.0:5555 on the network, too");
  }
  address.port = static_cast<std::uint16_t>(number);
  return address;
}

UdpSource::UdpSource(const UdpAddress& address) : address_(address) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_port = htons(address.port);
  inet_pton(AF_INET, address.host.c_str(), &local.sin_addr);
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0) {
    const int error_number = errno;
    if (fd_ >= 0) close(fd_);
    throw explain(address, error_number);
  }
}

UdpSource::~UdpSource() {
  close(fd_);
}

std::size_t UdpSource::read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) {
  pollfd waiting{fd_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(std::lround(timeout_s * 1e3))) <= 0) return 0;
  const ssize_t count = recv(fd_, buffer, capacity, 0);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR || errno == ECONNREFUSED) return 0;
  throw explain(address_, errno);
}

}  // namespace stereo_nav::imu
