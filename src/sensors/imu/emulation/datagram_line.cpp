#include "sensors/imu/emulation/datagram_line.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sensors/serial/emulation/serial_line.h"

namespace stereo_nav::imu {

DatagramLine::DatagramLine(const DatagramOptions& options) : options_(options), random_(options.seed) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd_ < 0) throw std::runtime_error(std::string("cannot make a UDP socket: ") + std::strerror(errno));
}

DatagramLine::~DatagramLine() {
  close(fd_);
}

void DatagramLine::send(const std::vector<std::uint8_t>& frame) {
  if (happens(options_.drop_probability)) return;
  std::vector<std::uint8_t> datagram;
  serial::LineFaults(options_.corrupt_probability, 0.0, static_cast<unsigned>(random_()))
      .pass(frame.data(), frame.size(), datagram);
  if (overtaken_.empty() && happens(options_.overtake_probability)) {
    overtaken_ = datagram;
    return;
  }
  pass(datagram);
  if (!overtaken_.empty()) pass(overtaken_);
  overtaken_.clear();
  if (happens(options_.double_probability)) pass(datagram);
}

/// What does not arrive is lost, as on any network.
void DatagramLine::pass(const std::vector<std::uint8_t>& datagram) {
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_port = htons(options_.target.port);
  inet_pton(AF_INET, options_.target.host.c_str(), &target.sin_addr);
  sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&target), sizeof target);
}

}  // namespace stereo_nav::imu
