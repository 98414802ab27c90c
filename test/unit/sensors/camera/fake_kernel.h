#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sensors/camera/device_finder.h"
#include "sensors/camera/kernel.h"

namespace stereo_nav::camera {

/// A camera that delivers small GREY images at a steady rate, whose first four bytes are the frame number,
/// and has every fault that a test wants. Fields are to be changed under FakeKernel::change() once threads
/// run.
struct FakeCamera {
  std::string card = "Fake camera";
  std::string bus_info = "usb-fake-1";
  bool metadata_node = false;
  std::uint32_t fourcc = 0;           ///< GREY
  std::vector<std::uint8_t> payload;  ///< sent in place of the pattern
  std::int64_t period_ns = 4'000'000;
  std::int64_t offset_ns = 0;       ///< of the stamps against the grid of periods
  std::uint32_t stamp_flags = 0;    ///< V4L2_BUF_FLAG_...; monotonic by default
  std::int64_t stamp_shift_ns = 0;  ///< added to every stamp

  int open_error = 0;
  int format_error = 0;
  int buffers_error = 0;
  int stream_on_error = 0;
  int dequeue_error = 0;
  int width_instead = 0;  ///< what the driver makes of any width
  bool stalled = false;
  std::uint32_t lose_every = 0;   ///< the driver loses frames whose number this divides
  std::uint32_t break_every = 0;  ///< the driver flags such frames as broken
  struct FakeControl {
    std::uint32_t id;
    std::string description;
    std::int32_t minimum, maximum, value;
    std::uint32_t flags = 0;  ///< V4L2_CTRL_FLAG_...
  };
  std::vector<FakeControl> controls;

  // State of the driver.
  int opened = 0;
  bool streaming = false;
  std::int64_t started_ns = 0;
  std::uint32_t next_sequence = 0;
  std::uint32_t frames_sent = 0;
  std::uint32_t frames_lost = 0;
  std::uint32_t frames_broken = 0;
  std::vector<std::uint32_t> queued;
  std::uint32_t width = 0, height = 0;
};

/// Plays the system calls on fake cameras, named by their paths, in real time.
class FakeKernel : public Kernel {
 public:
  FakeKernel();
  ~FakeKernel() override;

  /// /dev/videoN of this kernel, below its own temporary folder.
  std::string path(int number) const;
  void plugIn(int number, const FakeCamera& camera);
  /// The camera's calls fail with ENODEV from now on, and its node is gone.
  void unplug(int number);
  DeviceFinder finder();

  template <class Change>
  void change(int number, Change&& apply) {
    const std::lock_guard<std::mutex> lock(mutex_);
    apply(cameras_.at(path(number)));
  }
  FakeCamera look(int number);
  int openDescriptors();
  int mappings();

  int open(const std::string& path) override;
  void close(int descriptor) override;
  int ioctl(int descriptor, unsigned long request, void* argument) override;
  void* map(int descriptor, std::size_t length, std::int64_t offset) override;
  void unmap(void* address, std::size_t length) override;
  Ready wait(int descriptor, int timeout_ms) override;
  std::int64_t monotonicNow() override { return linuxKernel().monotonicNow(); }
  std::int64_t realtimeNow() override { return linuxKernel().realtimeNow(); }

 private:
  static constexpr std::size_t kBufferBytes = 4096;
  struct Opened {
    std::string path;
    std::map<std::uint32_t, std::vector<std::uint8_t>*> buffers;  ///< mapped ones, by index
  };

  FakeCamera* cameraOf(int descriptor);
  std::int64_t dueAt(const FakeCamera& camera, std::uint32_t sequence) const;
  int control(FakeCamera& camera, unsigned long request, void* argument);
  int format(FakeCamera& camera, unsigned long request, void* argument);
  int dequeue(FakeCamera& camera, Opened& opened, void* argument);
  std::int64_t stampOf(const FakeCamera& camera, std::uint32_t sequence) const;

  std::mutex mutex_;
  std::filesystem::path root_;
  std::map<std::string, FakeCamera> cameras_;
  std::map<int, Opened> opened_;
  std::map<void*, std::unique_ptr<std::vector<std::uint8_t>>> memory_;
  int next_descriptor_ = 1000;
};

}  // namespace stereo_nav::camera
