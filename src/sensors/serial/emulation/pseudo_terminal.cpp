#include "sensors/serial/emulation/pseudo_terminal.h"

#include <asm/termbits.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace stereo_nav::serial {

namespace fs = std::filesystem;

namespace {

/// A rate that no module uses marks a terminal that no program has configured.
constexpr speed_t kUnconfigured_baud = 7;

}  // namespace

PseudoTerminal::PseudoTerminal() {
  fd_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, 128> name{};
  if (fd_ < 0 || grantpt(fd_) != 0 || unlockpt(fd_) != 0 || ptsname_r(fd_, name.data(), name.size()) != 0) {
    const std::string reason = std::strerror(errno);
    if (fd_ >= 0) close(fd_);
    throw std::runtime_error("cannot make a pseudo-terminal (" + reason + "): is /dev/pts mounted?");
  }
  path_ = name.data();
  termios2 settings{};
  ioctl(fd_, TCGETS2, &settings);
  settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
  settings.c_ispeed = settings.c_ospeed = kUnconfigured_baud;
  ioctl(fd_, TCSETS2, &settings);
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code ignored;
  for (const std::string& link_path : links_) {
    if (fs::read_symlink(link_path, ignored) == fs::path(path_)) fs::remove(link_path, ignored);
  }
  close(fd_);
}

void PseudoTerminal::link(const std::string& link_path) {
  std::error_code ignored;
  fs::remove(link_path, ignored);
  if (fs::path(link_path).has_parent_path()) fs::create_directories(fs::path(link_path).parent_path());
  fs::create_symlink(path_, link_path);
  links_.push_back(link_path);
}

std::size_t PseudoTerminal::write(const std::vector<std::uint8_t>& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(fd_, bytes.data() + written, bytes.size() - written);
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  return written;
}

std::vector<std::uint8_t> PseudoTerminal::read() {
  std::vector<std::uint8_t> bytes(4096);
  const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

std::optional<int> PseudoTerminal::baudRate() const {
  termios2 settings{};
  if (ioctl(fd_, TCGETS2, &settings) != 0 || settings.c_ospeed == kUnconfigured_baud) return std::nullopt;
  return static_cast<int>(settings.c_ospeed);
}

}  // namespace stereo_nav::serial
