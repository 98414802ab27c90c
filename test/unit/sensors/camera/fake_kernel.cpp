#include "unit/sensors/camera/fake_kernel.h"

#include <linux/videodev2.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <thread>

namespace stereo_nav::camera {
namespace {

template <std::size_t N>
void setText(unsigned char (&field)[N], const std::string& text) {
  std::snprintf(reinterpret_cast<char*>(field), N, "%s", text.c_str());
}

}  // namespace

FakeKernel::FakeKernel() {
  std::string pattern = (std::filesystem::temp_directory_path() / "fake_kernel_XXXXXX").string();
  root_ = mkdtemp(pattern.data());
  std::filesystem::create_directories(root_ / "dev");
}

FakeKernel::~FakeKernel() {
  std::filesystem::remove_all(root_);
}

std::string FakeKernel::path(int number) const {
  return (root_ / "dev/video").string() + std::to_string(number);
}

void FakeKernel::plugIn(int number, const FakeCamera& camera) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cameras_[path(number)] = camera;
  std::ofstream(path(number)) << "";
}

void FakeKernel::unplug(int number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cameras_.erase(path(number));
  std::filesystem::remove(path(number));
}

DeviceFinder FakeKernel::finder() {
  return DeviceFinder(*this, root_ / "dev", root_ / "sys");
}

FakeCamera FakeKernel::look(int number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return cameras_.at(path(number));
}

int FakeKernel::openDescriptors() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(opened_.size());
}

int FakeKernel::mappings() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(memory_.size());
}

int FakeKernel::open(const std::string& path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = cameras_.find(path);
  if (found == cameras_.end()) return -ENOENT;
  if (found->second.open_error != 0) return -found->second.open_error;
  ++found->second.opened;
  opened_[next_descriptor_] = {path, {}};
  return next_descriptor_++;
}

void FakeKernel::close(int descriptor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  opened_.erase(descriptor);
}

FakeCamera* FakeKernel::cameraOf(int descriptor) {
  const auto found = cameras_.find(opened_.at(descriptor).path);
  return found == cameras_.end() ? nullptr : &found->second;
}

void* FakeKernel::map(int descriptor, std::size_t length, std::int64_t offset) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto memory = std::make_unique<std::vector<std::uint8_t>>(length);
  void* address = memory->data();
  opened_.at(descriptor).buffers[static_cast<std::uint32_t>(offset)] = memory.get();
  memory_[address] = std::move(memory);
  return address;
}

void FakeKernel::unmap(void* address, std::size_t) {
  const std::lock_guard<std::mutex> lock(mutex_);
  memory_.erase(address);
}

std::int64_t FakeKernel::dueAt(const FakeCamera& camera, std::uint32_t sequence) const {
  return camera.started_ns + (sequence + 1) * camera.period_ns + camera.offset_ns;
}

/// On a grid of periods since the clock's zero, so that two cameras' stamps are `offset_ns` apart.
std::int64_t FakeKernel::stampOf(const FakeCamera& camera, std::uint32_t sequence) const {
  return camera.started_ns + sequence * camera.period_ns + camera.offset_ns + camera.stamp_shift_ns;
}

Kernel::Ready FakeKernel::wait(int descriptor, int timeout_ms) {
  const std::int64_t until_ns = monotonicNow() + timeout_ms * 1'000'000LL;
  std::int64_t due_ns = 0;
  do {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const FakeCamera* camera = cameraOf(descriptor);
      if (camera == nullptr || camera->dequeue_error != 0) return Ready::kError;
      due_ns = dueAt(*camera, camera->next_sequence);
      if (due_ns <= monotonicNow() && !camera->stalled && !camera->queued.empty()) return Ready::kFrame;
    }
    // Soon enough for the next frame, and for a fault that the test makes meanwhile.
    constexpr std::int64_t kShortest_ns = 200'000, kLongest_ns = 2'000'000;
    std::this_thread::sleep_for(
        std::chrono::nanoseconds(std::clamp(due_ns - monotonicNow(), kShortest_ns, kLongest_ns)));
  } while (monotonicNow() < until_ns);
  return Ready::kNo;
}

int FakeKernel::ioctl(int descriptor, unsigned long request, void* argument) {
  const std::lock_guard<std::mutex> lock(mutex_);
  FakeCamera* camera = cameraOf(descriptor);
  if (camera == nullptr) return -ENODEV;
  Opened& opened = opened_.at(descriptor);
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& reply = *static_cast<v4l2_capability*>(argument);
      setText(reply.driver, "fake");
      setText(reply.card, camera->card);
      setText(reply.bus_info, camera->bus_info);
      reply.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
      const auto caps = camera->metadata_node ? V4L2_CAP_META_CAPTURE : V4L2_CAP_VIDEO_CAPTURE;
      reply.device_caps = caps | V4L2_CAP_STREAMING;
      return 0;
    }
    case VIDIOC_REQBUFS: {
      if (camera->buffers_error != 0) return -camera->buffers_error;
      camera->queued.clear();
      return 0;
    }
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      buffer.length = static_cast<std::uint32_t>(std::max(kBufferBytes, camera->payload.size()));
      buffer.m.offset = buffer.index;
      return 0;
    }
    case VIDIOC_QBUF:
      camera->queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_DQBUF:
      return dequeue(*camera, opened, argument);
    case VIDIOC_STREAMON:
      if (camera->stream_on_error != 0) return -camera->stream_on_error;
      // All cameras count from the same grid of periods.
      camera->started_ns = monotonicNow() / camera->period_ns * camera->period_ns;
      camera->next_sequence = 0;
      camera->streaming = true;
      return 0;
    case VIDIOC_STREAMOFF:
      camera->streaming = false;
      return 0;
    case VIDIOC_QUERYCTRL:
    case VIDIOC_G_CTRL:
    case VIDIOC_S_CTRL:
      return control(*camera, request, argument);
    default:
      return format(*camera, request, argument);
  }
}

int FakeKernel::format(FakeCamera& camera, unsigned long request, void* argument) {
  const std::uint32_t fourcc = camera.fourcc != 0 ? camera.fourcc : V4L2_PIX_FMT_GREY;
  if (request == VIDIOC_ENUM_FMT) {
    auto& description = *static_cast<v4l2_fmtdesc*>(argument);
    if (description.index > 0) return -EINVAL;
    description.pixelformat = fourcc;
    return 0;
  }
  if (request == VIDIOC_S_FMT) {
    if (camera.format_error != 0) return -camera.format_error;
    auto& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
    if (camera.width_instead != 0) pixels.width = static_cast<std::uint32_t>(camera.width_instead);
    pixels.pixelformat = fourcc;
    pixels.bytesperline = pixels.width;
    camera.width = pixels.width;
    camera.height = pixels.height;
    return 0;
  }
  if (request == VIDIOC_S_PARM) {
    static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {
        static_cast<std::uint32_t>(camera.period_ns / 1000), 1'000'000};
    return 0;
  }
  return -ENOTTY;
}

int FakeKernel::control(FakeCamera& camera, unsigned long request, void* argument) {
  if (request == VIDIOC_QUERYCTRL) {
    auto& query = *static_cast<v4l2_queryctrl*>(argument);
    const std::uint32_t after = query.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
    for (const auto& known : camera.controls) {
      if (known.id <= after) continue;
      query = {};
      query.id = known.id;
      query.type = V4L2_CTRL_TYPE_INTEGER;
      setText(query.name, known.description);
      query.minimum = known.minimum;
      query.maximum = known.maximum;
      query.flags = known.flags;
      return 0;
    }
    return -EINVAL;
  }
  auto& setting = *static_cast<v4l2_control*>(argument);
  for (auto& known : camera.controls) {
    if (known.id != setting.id) continue;
    if (request == VIDIOC_S_CTRL) known.value = std::clamp(setting.value, known.minimum, known.maximum);
    setting.value = known.value;
    return 0;
  }
  return -EINVAL;
}

int FakeKernel::dequeue(FakeCamera& camera, Opened& opened, void* argument) {
  if (camera.dequeue_error != 0) return -camera.dequeue_error;
  while (camera.lose_every != 0 && camera.next_sequence % camera.lose_every == 0 &&
         dueAt(camera, camera.next_sequence) <= monotonicNow()) {
    // The very first frame's loss cannot be told from the counter.
    if (camera.next_sequence != 0) ++camera.frames_lost;
    ++camera.next_sequence;
  }
  const std::uint32_t sequence = camera.next_sequence;
  if (camera.stalled || camera.queued.empty() || dueAt(camera, sequence) > monotonicNow()) return -EAGAIN;

  auto& buffer = *static_cast<v4l2_buffer*>(argument);
  buffer.index = camera.queued.front();
  camera.queued.erase(camera.queued.begin());
  auto& memory = *opened.buffers.at(buffer.index);
  if (camera.payload.empty()) {
    std::memcpy(memory.data(), &sequence, sizeof(sequence));
    buffer.bytesused = camera.width * camera.height;
  } else {
    std::copy(camera.payload.begin(), camera.payload.end(), memory.begin());
    buffer.bytesused = static_cast<std::uint32_t>(camera.payload.size());
  }
  const bool broken = camera.break_every != 0 && sequence % camera.break_every == 0;
  buffer.flags = camera.stamp_flags != 0 ? camera.stamp_flags
                                         : V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  if (broken) buffer.flags |= V4L2_BUF_FLAG_ERROR;
  const std::int64_t stamp_us = stampOf(camera, sequence) / 1000;
  buffer.timestamp.tv_sec = stamp_us / 1'000'000;
  buffer.timestamp.tv_usec = stamp_us % 1'000'000;
  buffer.sequence = sequence;
  camera.next_sequence = sequence + 1;
  ++camera.frames_sent;
  camera.frames_broken += broken ? 1 : 0;
  return 0;
}

}  // namespace stereo_nav::camera
