#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "sensors/camera/kernel.h"

namespace stereo_nav::camera {

/// The real system calls, with a record of every buffer that a driver handed out.
class RecordingKernel : public Kernel {
 public:
  struct Buffer {
    std::int64_t stamp_us;
    std::uint32_t sequence;
    std::uint32_t flags;
  };

  int open(const std::string& path) override {
    const int descriptor = camera::linuxKernel().open(path);
    const std::lock_guard<std::mutex> lock(mutex_);
    paths_[descriptor] = path;
    return descriptor;
  }
  void close(int descriptor) override { camera::linuxKernel().close(descriptor); }
  int ioctl(int descriptor, unsigned long request, void* argument) override {
    const int result = camera::linuxKernel().ioctl(descriptor, request, argument);
    if (request == VIDIOC_DQBUF && result == 0) {
      const auto& buffer = *static_cast<const v4l2_buffer*>(argument);
      const std::lock_guard<std::mutex> lock(mutex_);
      buffers_[paths_.at(descriptor)].push_back(
          {buffer.timestamp.tv_sec * 1'000'000LL + buffer.timestamp.tv_usec, buffer.sequence, buffer.flags});
    }
    return result;
  }
  void* map(int descriptor, std::size_t length, std::int64_t offset) override {
    return camera::linuxKernel().map(descriptor, length, offset);
  }
  void unmap(void* address, std::size_t length) override { camera::linuxKernel().unmap(address, length); }
  Ready wait(int descriptor, int timeout_ms) override {
    return camera::linuxKernel().wait(descriptor, timeout_ms);
  }
  std::int64_t monotonicNow() override { return camera::linuxKernel().monotonicNow(); }
  std::int64_t realtimeNow() override { return camera::linuxKernel().realtimeNow(); }

  std::vector<Buffer> buffersOf(const std::string& path) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return buffers_[path];
  }

 private:
  std::mutex mutex_;
  std::map<int, std::string> paths_;
  std::map<std::string, std::vector<Buffer>> buffers_;
};

}  // namespace stereo_nav::camera
