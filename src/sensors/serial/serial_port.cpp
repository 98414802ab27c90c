#include "sensors/serial/serial_port.h"

#include <asm/termbits.h>
#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

namespace stereo_nav::serial {
namespace {

/// Name of the group that owns the device; `dialout` on Debian and Ubuntu.
std::string owningGroup(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return "dialout";
  const group* entry = getgrgid(status.st_gid);
  return entry != nullptr && std::strcmp(entry->gr_name, "root") != 0 ? entry->gr_name : "dialout";
}

SerialError busy(const std::string& path) {
  return {PortFault::kBusy, path + " is in use by another program; `fuser -v " + path +
                                "` names it. Stop it (a second bridge, a terminal program, ModemManager)"};
}

SerialError lost(const std::string& path, const std::string& seen) {
  return {PortFault::kLost,
          path + " has gone (" + seen + "): unplugged, or the module lost power; check the cable"};
}

}  // namespace

SerialError explainOpenError(const std::string& path, int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return {PortFault::kMissing,
              path +
                  " does not exist: module not plugged in, or under another name; `ls -l /dev/serial/by-id/` "
                  "shows what is there"};
    case EACCES:
    case EPERM: {
      const std::string group = owningGroup(path);
      return {PortFault::kPermission, "no permission to open " + path + ": add the user to group " + group +
                                          " with `sudo usermod -aG " + group + " $USER` and log in again"};
    }
    case EBUSY:
      return busy(path);
    default:
      return {PortFault::kOther, "cannot open " + path + ": " + std::strerror(error_number)};
  }
}

SerialPort::SerialPort(const std::string& path, int baud_rate) : path_(path) {
  fd_ = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) throw explainOpenError(path, errno);
  try {
    lock();
    configure(baud_rate);
  } catch (...) {
    close(fd_);
    throw;
  }
}

SerialPort::~SerialPort() {
  close(fd_);
}

void SerialPort::lock() {
  if (flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) throw busy(path_);
  ioctl(fd_, TIOCEXCL);
}

/// The kernel's termios2 takes any number as baud rate, which the C library's interface does not.
void SerialPort::configure(int baud_rate) {
  termios2 settings{};
  if (ioctl(fd_, TCGETS2, &settings) != 0) {
    throw SerialError(PortFault::kNotSerial,
                      path_ + " is not a serial port (" + std::strerror(errno) + "): check the port's name");
  }
  settings.c_iflag = 0;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
  settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(baud_rate);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  if (ioctl(fd_, TCSETS2, &settings) != 0) {
    throw SerialError(PortFault::kBadBaudRate, path_ + " does not take " + std::to_string(baud_rate) +
                                                   " baud (" + std::strerror(errno) +
                                                   "): choose a rate that adapter and module both have");
  }
  ioctl(fd_, TCFLSH, TCIFLUSH);
}

std::size_t SerialPort::read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) {
  pollfd waiting{fd_, POLLIN, 0};
  const int ready = poll(&waiting, 1, static_cast<int>(std::lround(timeout_s * 1e3)));
  if (ready <= 0) return 0;
  if ((waiting.revents & POLLIN) == 0) throw lost(path_, "hang-up");
  const ssize_t count = ::read(fd_, buffer, capacity);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  throw lost(path_, count == 0 ? "end of input" : std::strerror(errno));
}

void SerialPort::write(const std::uint8_t* bytes, std::size_t size) {
  constexpr int kPatience_ms = 1000;
  while (size > 0) {
    const ssize_t count = ::write(fd_, bytes, size);
    if (count > 0) {
      bytes += count;
      size -= static_cast<std::size_t>(count);
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else if (count < 0 && errno == EAGAIN) {
      pollfd waiting{fd_, POLLOUT, 0};
      if (poll(&waiting, 1, kPatience_ms) == 0) throw lost(path_, "it takes no bytes");
    } else {
      throw lost(path_, count == 0 ? "nothing was written" : std::strerror(errno));
    }
  }
}

void SerialPort::setDtr(bool on) {
  const int line = TIOCM_DTR;
  ioctl(fd_, on ? TIOCMBIS : TIOCMBIC, &line);
}

}  // namespace stereo_nav::serial
