#include "sensors/camera/pixel_format.h"

#include <linux/videodev2.h>

namespace stereo_nav::camera {

std::uint32_t fourccOf(PixelFormat format) {
  switch (format) {
    case PixelFormat::kAny:
      return 0;
    case PixelFormat::kMjpg:
      return V4L2_PIX_FMT_MJPEG;
    case PixelFormat::kYuyv:
      return V4L2_PIX_FMT_YUYV;
    case PixelFormat::kUyvy:
      return V4L2_PIX_FMT_UYVY;
    case PixelFormat::kGrey:
      return V4L2_PIX_FMT_GREY;
    case PixelFormat::kNv12:
      return V4L2_PIX_FMT_NV12;
  }
  return 0;
}

PixelFormat pixelFormatOf(std::uint32_t fourcc) {
  switch (fourcc) {
    case V4L2_PIX_FMT_MJPEG:
    case V4L2_PIX_FMT_JPEG:
      return PixelFormat::kMjpg;
    case V4L2_PIX_FMT_YUYV:
      return PixelFormat::kYuyv;
    case V4L2_PIX_FMT_UYVY:
      return PixelFormat::kUyvy;
    case V4L2_PIX_FMT_GREY:
      return PixelFormat::kGrey;
    case V4L2_PIX_FMT_NV12:
      return PixelFormat::kNv12;
    default:
      return PixelFormat::kAny;
  }
}

std::string fourccText(std::uint32_t fourcc) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const auto character = static_cast<char>((fourcc >> shift) & 0x7f);
    if (character != ' ' && character != '\0') text += character;
  }
  return text;
}

std::size_t minimumBytesPerLine(PixelFormat format, int width) {
  const auto pixels = static_cast<std::size_t>(width);
  switch (format) {
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 2 * pixels;
    case PixelFormat::kGrey:
    case PixelFormat::kNv12:
      return pixels;
    case PixelFormat::kMjpg:
    case PixelFormat::kAny:
      return 0;
  }
  return 0;
}

std::size_t imageBytes(PixelFormat format, int height, std::size_t bytes_per_line) {
  const std::size_t plane = static_cast<std::size_t>(height) * bytes_per_line;
  return format == PixelFormat::kNv12 ? plane + plane / 2 : plane;
}

}  // namespace stereo_nav::camera
