#include "unit/sensors/laser/modem_lines.h"

#include <asm/termbits.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>

namespace stereo_nav::laser {
namespace {

int last_dtr = -1;

}  // namespace

int lastDtr() {
  return last_dtr;
}

void forgetDtr() {
  last_dtr = -1;
}

}  // namespace stereo_nav::laser

/// Takes the place of the C library's, notes DTR, and calls the kernel.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if ((request == TIOCMBIS || request == TIOCMBIC) && (*static_cast<int*>(argument) & TIOCM_DTR) != 0) {
    stereo_nav::laser::last_dtr = request == TIOCMBIS ? 1 : 0;
  }
  return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}
