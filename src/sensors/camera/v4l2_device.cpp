#include "sensors/camera/v4l2_device.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>

namespace stereo_nav::camera {
namespace {

/// The order in which formats are tried when the user asks for none: compressed first, since two uncompressed
/// cameras rarely fit onto one USB bus.
constexpr PixelFormat kPreference[] = {PixelFormat::kMjpg, PixelFormat::kYuyv, PixelFormat::kUyvy,
                                       PixelFormat::kNv12, PixelFormat::kGrey};

template <std::size_t N>
std::string textOf(const unsigned char (&field)[N]) {
  const auto* text = reinterpret_cast<const char*>(field);
  return {text, std::find(text, text + N, '\0')};
}

std::string sizeText(std::uint32_t fourcc, unsigned width, unsigned height) {
  return fourccText(fourcc) + " " + std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

bool LentBuffer::isBroken() const {
  return (flags & V4L2_BUF_FLAG_ERROR) != 0 || size == 0;
}

V4l2Device::V4l2Device(Kernel& kernel, const std::string& path)
    : descriptor_(kernel, path), controls_(descriptor_) {
  queryCapabilities();
}

V4l2Device::~V4l2Device() {
  stopStreaming();
}

void V4l2Device::queryCapabilities() {
  v4l2_capability reply{};
  descriptor_.callOrThrow(VIDIOC_QUERYCAP, &reply, Step::kQuery, "");
  capabilities_.driver = textOf(reply.driver);
  capabilities_.card = textOf(reply.card);
  capabilities_.bus_info = textOf(reply.bus_info);
  const auto of_this_node =
      (reply.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? reply.device_caps : reply.capabilities;
  constexpr auto kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  capabilities_.captures_video = (of_this_node & kNeeded) == kNeeded;
}

std::vector<std::uint32_t> V4l2Device::formatsToTry(PixelFormat wanted) {
  if (wanted != PixelFormat::kAny) return {fourccOf(wanted)};
  std::vector<std::uint32_t> offered;
  v4l2_fmtdesc description{};
  description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; descriptor_.call(VIDIOC_ENUM_FMT, &description) == 0; ++description.index) {
    offered.push_back(description.pixelformat);
  }
  std::vector<std::uint32_t> usable;
  for (const auto preferred : kPreference) {
    const auto found = std::find_if(offered.begin(), offered.end(), [preferred](std::uint32_t fourcc) {
      return pixelFormatOf(fourcc) == preferred;
    });
    if (found != offered.end()) usable.push_back(*found);
  }
  if (usable.empty()) {
    std::string names;
    for (const auto fourcc : offered) names += (names.empty() ? "" : ", ") + fourccText(fourcc);
    throw CaptureError(Step::kSetFormat, 0,
                       path() + ": offers " + (names.empty() ? "no image format" : names) +
                           ", none of MJPG, YUYV, UYVY, NV12, GREY: this camera cannot be used");
  }
  return usable;
}

ActiveFormat V4l2Device::configure(const FormatRequest& request) {
  std::string got;
  for (const auto fourcc : formatsToTry(request.format)) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    format.fmt.pix.width = static_cast<std::uint32_t>(request.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(request.height);
    format.fmt.pix.pixelformat = fourcc;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    format_text_ = sizeText(fourcc, format.fmt.pix.width, format.fmt.pix.height);
    descriptor_.callOrThrow(VIDIOC_S_FMT, &format, Step::kSetFormat, format_text_);
    const auto& active = format.fmt.pix;
    const bool as_wanted = pixelFormatOf(active.pixelformat) == pixelFormatOf(fourcc) &&
                           static_cast<int>(active.width) == request.width &&
                           static_cast<int>(active.height) == request.height;
    if (as_wanted) {
      ActiveFormat result;
      const auto pixel_format = pixelFormatOf(active.pixelformat);
      const auto shortest = minimumBytesPerLine(pixel_format, request.width);
      result.layout = {pixel_format, request.width, request.height,
                       shortest == 0 ? 0 : std::max<std::size_t>(active.bytesperline, shortest)};
      result.rate_hz = setRate(request.rate_hz);
      return result;
    }
    got += (got.empty() ? "" : ", ") + sizeText(active.pixelformat, active.width, active.height);
  }
  throw CaptureError(
      Step::kSetFormat, 0,
      path() + ": asked for " + std::to_string(request.width) + "x" + std::to_string(request.height) +
          " in " +
          (request.format == PixelFormat::kAny ? "any format" : fourccText(fourccOf(request.format))) +
          ", the driver offers " + got +
          " instead; set width, height and format to what `rosrun stereo_nav list_cameras` shows");
}

double V4l2Device::setRate(double rate_hz) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  auto& interval = parameters.parm.capture.timeperframe;
  constexpr std::uint32_t kScale = 1000;
  interval.numerator = kScale;
  interval.denominator = static_cast<std::uint32_t>(std::lround(rate_hz * kScale));
  const bool accepted = descriptor_.call(VIDIOC_S_PARM, &parameters) == 0 && interval.numerator != 0;
  if (!accepted) return 0.0;  // not every driver can
  return static_cast<double>(interval.denominator) / interval.numerator;
}

void V4l2Device::startStreaming(int buffers) {
  try {
    mapBuffers(buffers);
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    descriptor_.callOrThrow(VIDIOC_STREAMON, &type, Step::kStreamOn, format_text_);
    streaming_ = true;
  } catch (...) {
    unmapBuffers();
    throw;
  }
}

void V4l2Device::mapBuffers(int count) {
  v4l2_requestbuffers request{};
  request.count = static_cast<std::uint32_t>(count);
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  descriptor_.callOrThrow(VIDIOC_REQBUFS, &request, Step::kGetBuffers, format_text_);
  for (std::uint32_t index = 0; index < request.count; ++index) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    descriptor_.callOrThrow(VIDIOC_QUERYBUF, &buffer, Step::kGetBuffers, format_text_);
    void* address = descriptor_.kernel().map(descriptor_.number(), buffer.length, buffer.m.offset);
    if (address == nullptr) throw explainFailure(Step::kGetBuffers, ENOMEM, path(), "mapping memory");
    buffers_.push_back({address, buffer.length});
    descriptor_.callOrThrow(VIDIOC_QBUF, &buffer, Step::kQueue, format_text_);
  }
  if (buffers_.size() < 2) {
    throw CaptureError(Step::kGetBuffers, 0, path() + ": the driver gave fewer than two image buffers");
  }
}

void V4l2Device::unmapBuffers() noexcept {
  for (const auto& buffer : buffers_) descriptor_.kernel().unmap(buffer.address, buffer.length);
  buffers_.clear();
  v4l2_requestbuffers none{};
  none.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  none.memory = V4L2_MEMORY_MMAP;
  descriptor_.call(VIDIOC_REQBUFS, &none);  // fails on a device that has gone, which frees them, too
}

void V4l2Device::stopStreaming() noexcept {
  if (!streaming_) return;
  streaming_ = false;
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  descriptor_.call(VIDIOC_STREAMOFF, &type);
  unmapBuffers();
}

bool V4l2Device::wait(int timeout_ms) {
  switch (descriptor_.kernel().wait(descriptor_.number(), timeout_ms)) {
    case Kernel::Ready::kNo:
      return false;
    case Kernel::Ready::kFrame:
      return true;
    case Kernel::Ready::kError:
      break;
  }
  // Taking a frame tells which error it is.
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  const int result = descriptor_.call(VIDIOC_DQBUF, &buffer);
  throw explainFailure(Step::kWait, result < 0 && result != -EAGAIN ? -result : EIO, path(), format_text_);
}

std::optional<LentBuffer> V4l2Device::dequeue() {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  const int result = descriptor_.call(VIDIOC_DQBUF, &buffer);
  if (result == -EAGAIN) return std::nullopt;
  if (result < 0) throw explainFailure(Step::kDequeue, -result, path(), format_text_);
  if (buffer.index >= buffers_.size()) throw explainFailure(Step::kDequeue, EIO, path(), "unknown buffer");
  LentBuffer lent;
  lent.dequeued_ns = descriptor_.kernel().monotonicNow();
  lent.index = buffer.index;
  lent.data = static_cast<const std::uint8_t*>(buffers_[buffer.index].address);
  lent.size = std::min<std::size_t>(buffer.bytesused, buffers_[buffer.index].length);
  lent.stamp_ns = static_cast<std::int64_t>(buffer.timestamp.tv_sec) * 1'000'000'000 +
                  static_cast<std::int64_t>(buffer.timestamp.tv_usec) * 1'000;
  lent.flags = buffer.flags;
  lent.sequence = buffer.sequence;
  return lent;
}

void V4l2Device::giveBack(const LentBuffer& lent) {
  v4l2_buffer buffer{};
  buffer.index = lent.index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  descriptor_.callOrThrow(VIDIOC_QBUF, &buffer, Step::kQueue, format_text_);
}

}  // namespace stereo_nav::camera
