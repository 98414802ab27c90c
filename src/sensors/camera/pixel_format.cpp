#include "sensors/camera/pixel_format.h"

#include <linux/videodev2.h>

namespace stereo_nav::camera {

std::uint32_t fourccOf(PixelFormat format) {
  switch (format) {
    case PixelFormat::Any:
      return 0;
    case PixelFormat::Mjpg:
      return V4L2_PIX_FMT_MJPEG;
    case PixelFormat::Yuyv:
      return V4L2_PIX_FMT_YUYV;
    case PixelFormat::Uyvy:
      return V4L2_PIX_FMT_UYVY;
    case PixelFormat::Grey:
      return V4L2_PIX_FMT_GREY;
    case PixelFormat::Nv12:
      return V4L2_PIX_FMT_NV12;
  }
  return 0;
}

PixelFormat pixelFormatOf(std::uint32_t fourcc) {
  switch (fourcc) {
    case V4L2_PIX_FMT_MJPEG:
    case V4L2_PIX_FMT_JPEG:
      return PixelFormat::Mjpg;
    case V4L2_PIX_FMT_YUYV:
      return PixelFormat::Yuyv;
    case V4L2_PIX_FMT_UYVY:
      return PixelFormat::Uyvy;
    case V4L2_PIX_FMT_GREY:
      return PixelFormat::Grey;
    case V4L2_PIX_FMT_NV12:
      return PixelFormat::Nv12;
    default:
      return PixelFormat::Any;
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
    case PixelFormat::Yuyv:
    case PixelFormat::Uyvy:
      return 2 * pixels;
    case PixelFormat::Grey:
    case PixelFormat::Nv12:
      return pixels;
    case PixelFormat::Mjpg:
    case PixelFormat::Any:
      return 0;
  }
  return 0;
}

std::size_t imageBytes(PixelFormat format, int height, std::size_t bytes_per_line) {
  const std::size_t plane = static_cast<std::size_t>(height) * bytes_per_line;
  return format == PixelFormat::Nv12 ? plane + plane / 2 : plane;
}

}  // namespace stereo_nav::camera
