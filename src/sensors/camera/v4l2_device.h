#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensors/camera/capture_error.h"
#include "sensors/camera/decoder.h"
#include "sensors/camera/device_controls.h"
#include "sensors/camera/kernel.h"
#include "sensors/camera/offered_formats.h"
#include "sensors/camera/pixel_format.h"
#include "sensors/camera/v4l2_descriptor.h"

namespace stereo_nav::camera {

/// The driver's description of itself.
struct Capabilities {
  std::string driver;
  std::string card;
  std::string bus_info;
  bool captures_video = false;  ///< single-planar capture with streaming, which is what webcams have
};

/// What a driver is asked for; it may choose something similar.
struct FormatRequest {
  PixelFormat format = PixelFormat::kAny;
  int width = 640;
  int height = 480;
  double rate_hz = 30.0;
};

/// What the driver agreed to.
struct ActiveFormat {
  ImageLayout layout;
  double rate_hz = 0.0;  ///< 0 if the driver does not report it
};

/// A frame in the driver's memory, borrowed until it is given back.
struct LentBuffer {
  std::uint32_t index = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
  std::int64_t stamp_ns = 0;  ///< as the driver wrote it; `flags` says of which clock and moment
  std::uint32_t flags = 0;    ///< V4L2_BUF_FLAG_...
  std::uint32_t sequence = 0;
  std::int64_t dequeued_ns = 0;  ///< when it was taken from the driver, CLOCK_MONOTONIC

  bool isBroken() const;
};

/// A V4L2 capture device with memory-mapped buffers. Every failure throws a CaptureError; the destructor
/// releases everything in any case. Not for use by several threads.
class V4l2Device {
 public:
  /// Opens the device and asks for its capabilities.
  V4l2Device(Kernel& kernel, const std::string& path);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  const std::string& path() const { return descriptor_.path(); }
  const Capabilities& capabilities() const { return capabilities_; }

  /// Sets size, format and rate. Throws when the driver changes the size or the format. Another rate is
  /// accepted and returned in the result.
  ActiveFormat configure(const FormatRequest& request);
  std::vector<OfferedFormat> offeredFormats() const { return camera::offeredFormats(descriptor_); }

  void startStreaming(int buffers);
  void stopStreaming() noexcept;
  /// False on time-out. Throws when the driver reports an error and has no frame.
  bool wait(int timeout_ms);
  /// The oldest filled buffer, or nothing.
  std::optional<LentBuffer> dequeue();
  void giveBack(const LentBuffer& buffer);

  DeviceControls& controls() { return controls_; }

 private:
  struct Mapping {
    void* address;
    std::size_t length;
  };

  void queryCapabilities();
  std::vector<std::uint32_t> formatsToTry(PixelFormat wanted);
  double setRate(double rate_hz);
  void mapBuffers(int count);
  void unmapBuffers() noexcept;

  V4l2Descriptor descriptor_;
  Capabilities capabilities_;
  DeviceControls controls_;
  std::vector<Mapping> buffers_;
  std::string format_text_;  ///< for messages
  bool streaming_ = false;
};

}  // namespace stereo_nav::camera
