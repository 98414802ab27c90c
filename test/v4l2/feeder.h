#pragma once

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace stereo_nav::capture {

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

/// Writes images into a v4l2loopback device at a steady rate, on a grid of periods that all feeders share.
class Feeder {
 public:
  using Duration = std::chrono::nanoseconds;
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
    if (descriptor_ < 0 || ::ioctl(descriptor_, VIDIOC_S_FMT, &format) != 0) {
      throw std::runtime_error("cannot feed " + path);
    }
  }

  ~Feeder() {
    stop();
    ::close(descriptor_);
  }

  void start(std::chrono::steady_clock::time_point first, Duration period, Source source) {
    running_ = true;
    thread_ = std::thread([this, first, period, source = std::move(source)] {
      for (std::uint32_t counter = 0; running_; ++counter) {
        const auto bytes = source(counter);
        const auto due = first + counter * period;
        std::this_thread::sleep_until(due);
        // Too late to be what its time says: not sent, as a camera would skip it.
        if (std::chrono::steady_clock::now() - due > period / 8) continue;
        if (::write(descriptor_, bytes.data(), bytes.size()) < 0) break;
      }
    });
  }

  void stop() {
    running_ = false;
    if (thread_.joinable()) thread_.join();
  }

 private:
  int descriptor_;
  std::atomic<bool> running_{false};
  std::thread thread_;
};

inline std::vector<std::uint8_t> jpegOf(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes);
  return bytes;
}

}  // namespace stereo_nav::capture
