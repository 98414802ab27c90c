#include "nodes/teleop/terminal_keys.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <stdexcept>

namespace stereo_nav::nodes {

TerminalKeys::TerminalKeys(int fd) : fd_(fd) {
  if (tcgetattr(fd_, &before_) != 0)
    throw std::runtime_error(
        "the standard input is no terminal, so that no keys can be read: start teleop in a terminal of its own, by "
        "`rosrun stereo_nav teleop`");
  termios settings = before_;
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // ISIG stays: Ctrl-C ends
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  tcsetattr(fd_, TCSANOW, &settings);
}

TerminalKeys::~TerminalKeys() {
  tcsetattr(fd_, TCSANOW, &before_);
}

std::vector<char> TerminalKeys::read(double timeout_s) {
  pollfd waiting{fd_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(std::lround(1e3 * timeout_s))) <= 0) return {};
  std::array<char, 256> buffer{};
  const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return {};
  closed_ = count <= 0;
  return {buffer.begin(), buffer.begin() + (count > 0 ? count : 0)};
}

}  // namespace stereo_nav::nodes
