#include "sensors/camera/kernel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace stereo_nav::camera {
namespace {

std::int64_t readClock(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

class LinuxKernel : public Kernel {
 public:
  int open(const std::string& path) override {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return descriptor >= 0 ? descriptor : -errno;
  }

  void close(int descriptor) override { ::close(descriptor); }

  int ioctl(int descriptor, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ::ioctl(descriptor, request, argument);
    } while (result == -1 && errno == EINTR);
    return result == -1 ? -errno : 0;
  }

  void* map(int descriptor, std::size_t length, std::int64_t offset) override {
    void* address = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
    return address == MAP_FAILED ? nullptr : address;
  }

  void unmap(void* address, std::size_t length) override { ::munmap(address, length); }

  Ready wait(int descriptor, int timeout_ms) override {
    pollfd request{descriptor, POLLIN, 0};
    const int ready = ::poll(&request, 1, timeout_ms);
    if (ready < 0) return errno == EINTR ? Ready::kNo : Ready::kError;
    if (ready == 0) return Ready::kNo;
    return (request.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0 ? Ready::kError : Ready::kFrame;
  }

  std::int64_t monotonicNow() override { return readClock(CLOCK_MONOTONIC); }
  std::int64_t realtimeNow() override { return readClock(CLOCK_REALTIME); }
};

}  // namespace

Kernel& linuxKernel() {
  static LinuxKernel kernel;
  return kernel;
}

}  // namespace stereo_nav::camera
