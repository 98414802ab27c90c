#pragma once

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace stereo_nav::camera {

/// A counter drawn as sixteen black or white fields, legible after JPEG.
inline cv::Mat drawCounter(int width, int height, std::uint32_t counter) {
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(100));
  const int field = width / 16;
  for (int bit = 0; bit < 16; ++bit) {
    cv::rectangle(image, {bit * field, 0, field, height / 2}, (counter >> bit) & 1u ? 230 : 20, cv::FILLED);
  }
  return image;
}

inline std::uint32_t readCounter(const cv::Mat& image) {
  const int field = image.cols / 16;
  std::uint32_t counter = 0;
  for (int bit = 0; bit < 16; ++bit) {
    const auto value = image.at<std::uint8_t>(image.rows / 4, bit * field + field / 2);
    if (value > 128) counter |= 1u << bit;
  }
  return counter;
}

/// Writes images into a v4l2loopback device at a steady rate, each stamped with the time at which it was due:
/// what a camera's driver would do, however late a busy machine lets this thread run.
class Feeder {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// The bytes of frame `counter`.
  using Source = std::function<std::vector<std::uint8_t>(std::uint32_t counter)>;

  Feeder(const std::string& path, std::uint32_t fourcc, int width, int height)
      : descriptor_(::open(path.c_str(), O_RDWR)) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = static_cast<std::uint32_t>(width);
    format.fmt.pix.height = static_cast<std::uint32_t>(height);
    format.fmt.pix.pixelformat = fourcc;
    format.fmt.pix.sizeimage = static_cast<std::uint32_t>(width * height * 2);
    format.fmt.pix.field = V4L2_FIELD_NONE;
    require(VIDIOC_S_FMT, &format);
    int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    require(VIDIOC_STREAMON, &type);
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    request.memory = V4L2_MEMORY_MMAP;
    require(VIDIOC_REQBUFS, &request);
    for (std::uint32_t index = 0; index < kBuffers; ++index) {
      v4l2_buffer buffer = bufferAt(index);
      require(VIDIOC_QUERYBUF, &buffer);
      length_ = buffer.length;
      memory_[index] =
          ::mmap(nullptr, length_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, buffer.m.offset);
      if (memory_[index] == MAP_FAILED) throw std::runtime_error("no memory to feed a camera");
    }
  }

  ~Feeder() {
    stop();
    for (void* memory : memory_) ::munmap(memory, length_);
    ::close(descriptor_);
  }

  void start(Time first, std::chrono::nanoseconds period, Source source) {
    running_ = true;
    thread_ = std::thread([this, first, period, source = std::move(source)] {
      for (std::uint32_t counter = 0; running_; ++counter) {
        const auto bytes = source(counter);
        const Time due = first + counter * period;
        std::this_thread::sleep_until(due);
        if (std::chrono::steady_clock::now() < due + period) send(counter, bytes, due);
      }
    });
  }

  void stop() {
    running_ = false;
    if (thread_.joinable()) thread_.join();
  }

 private:
  static constexpr std::uint32_t kBuffers = 4;

  void require(unsigned long request, void* argument) {
    if (::ioctl(descriptor_, request, argument) == 0) return;
    throw std::system_error(errno, std::generic_category(),
                            "feeding a camera, request " + std::to_string(_IOC_NR(request)));
  }

  static v4l2_buffer bufferAt(std::uint32_t index) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    buffer.memory = V4L2_MEMORY_MMAP;
    return buffer;
  }

  void send(std::uint32_t counter, const std::vector<std::uint8_t>& bytes, Time due) {
    const std::uint32_t index = counter % kBuffers;
    std::memcpy(memory_[index], bytes.data(), std::min<std::size_t>(bytes.size(), length_));
    v4l2_buffer buffer = bufferAt(index);
    buffer.bytesused = static_cast<std::uint32_t>(bytes.size());
    const auto due_us = std::chrono::duration_cast<std::chrono::microseconds>(due.time_since_epoch()).count();
    buffer.timestamp.tv_sec = due_us / 1'000'000;
    buffer.timestamp.tv_usec = due_us % 1'000'000;
    require(VIDIOC_QBUF, &buffer);
  }

  int descriptor_;
  std::array<void*, kBuffers> memory_{};
  std::size_t length_ = 0;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

inline std::vector<std::uint8_t> jpegOf(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes);
  return bytes;
}

}  // namespace stereo_nav::camera
