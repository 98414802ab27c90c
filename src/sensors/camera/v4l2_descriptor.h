#pragma once

#include <string>

#include "sensors/camera/capture_error.h"
#include "sensors/camera/kernel.h"

namespace stereo_nav::camera {

/// An open V4L2 device node; closed by the destructor.
class V4l2Descriptor {
 public:
  /// Throws CaptureError where the node cannot be opened.
  V4l2Descriptor(Kernel& kernel, const std::string& path);
  ~V4l2Descriptor();
  V4l2Descriptor(const V4l2Descriptor&) = delete;
  V4l2Descriptor& operator=(const V4l2Descriptor&) = delete;

  const std::string& path() const { return path_; }
  Kernel& kernel() const { return kernel_; }
  int number() const { return number_; }

  /// The ioctl's result: 0 or -errno.
  int call(unsigned long request, void* argument) const;
  /// Throws CaptureError where the ioctl fails; `details` say what was tried.
  void callOrThrow(unsigned long request, void* argument, Step step, const std::string& details) const;

 private:
  Kernel& kernel_;
  std::string path_;
  int number_;
};

}  // namespace stereo_nav::camera
