#pragma once

#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "support/background_command.h"
#include "support/wait.h"

namespace stereo_nav::test {

/// A port that nobody uses now.
inline int freePort() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  const bool good = bind(fd, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
                    getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) == 0;
  close(fd);
  if (!good) throw std::runtime_error("no free port");
  return ntohs(address.sin_port);
}

/// A ROS master of the test's own that can go and come again at the same address. While it exists, commands
/// that the test runs use it.
class OwnMaster {
 public:
  OwnMaster() : port_(freePort()) {
    const char* uri = std::getenv("ROS_MASTER_URI");
    uri_before_ = uri != nullptr ? uri : "";
    setenv("ROS_MASTER_URI", ("http://localhost:" + std::to_string(port_)).c_str(), 1);
  }
  ~OwnMaster() { setenv("ROS_MASTER_URI", uri_before_.c_str(), 1); }

  /// Starts the master and returns when it answers.
  void start() {
    process_.emplace("PATH=/usr/bin:$PATH exec rosmaster --core -p " + std::to_string(port_));
    const auto answersOrHasEnded = [this] { return answers() || process_->waitFor(0.0); };
    if (!waitUntil(answersOrHasEnded) || process_->waitFor(0.0)) {
      throw std::runtime_error("rosmaster does not answer: " + process_->output());
    }
  }
  /// Ends the master at once, as in a crash.
  void crash() { process_.reset(); }

 private:
  bool answers() const {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    const bool connected = connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    close(fd);
    return connected;
  }

  int port_;
  std::string uri_before_;
  std::optional<BackgroundCommand> process_;
};

}  // namespace stereo_nav::test
