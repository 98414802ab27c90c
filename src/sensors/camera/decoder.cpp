#include "sensors/camera/decoder.h"

#include <opencv2/imgproc.hpp>

#include "sensors/camera/jpeg_decoder.h"

namespace stereo_nav::camera {
namespace {

int conversionOf(PixelFormat format, Encoding encoding) {
  const bool mono = encoding == Encoding::kMono8;
  switch (format) {
    case PixelFormat::kYuyv:
      return mono ? cv::COLOR_YUV2GRAY_YUYV : cv::COLOR_YUV2BGR_YUYV;
    case PixelFormat::kUyvy:
      return mono ? cv::COLOR_YUV2GRAY_UYVY : cv::COLOR_YUV2BGR_UYVY;
    case PixelFormat::kNv12:
      return cv::COLOR_YUV2BGR_NV12;
    default:
      return cv::COLOR_GRAY2BGR;
  }
}

/// The driver's memory as a matrix. OpenCV's headers take no pointer to const; nothing is written through it.
cv::Mat driverView(const std::uint8_t* data, const ImageLayout& layout) {
  auto* memory = const_cast<std::uint8_t*>(data);
  const bool two_bytes = layout.format == PixelFormat::kYuyv || layout.format == PixelFormat::kUyvy;
  const int rows = layout.format == PixelFormat::kNv12 ? layout.height * 3 / 2 : layout.height;
  return {rows, layout.width, two_bytes ? CV_8UC2 : CV_8UC1, memory, layout.bytes_per_line};
}

}  // namespace

std::string encodingName(Encoding encoding) {
  return encoding == Encoding::kMono8 ? "mono8" : "bgr8";
}

cv::Mat DecodedImage::view() {
  return {height, width, encoding == Encoding::kMono8 ? CV_8UC1 : CV_8UC3, pixels.data(), step()};
}

void allocate(const ImageLayout& layout, Encoding encoding, DecodedImage& image) {
  image.width = layout.width;
  image.height = layout.height;
  image.encoding = encoding;
  image.pixels.resize(image.step() * static_cast<std::size_t>(image.height));
}

std::string decode(const std::uint8_t* data, std::size_t size, const ImageLayout& layout, Encoding encoding,
                   DecodedImage& image) {
  if (layout.format == PixelFormat::kMjpg) return internal::decodeJpeg(data, size, layout, encoding, image);
  if (layout.format == PixelFormat::kAny) return "the camera's pixel format is not known to the decoder";
  const std::size_t needed = imageBytes(layout.format, layout.height, layout.bytes_per_line);
  if (size < needed) {
    return "incomplete image: " + std::to_string(size) + " of " + std::to_string(needed) + " bytes";
  }

  allocate(layout, encoding, image);
  const cv::Mat source = driverView(data, layout);
  cv::Mat target = image.view();
  const bool has_grey_plane = layout.format == PixelFormat::kGrey || layout.format == PixelFormat::kNv12;
  if (encoding == Encoding::kMono8 && has_grey_plane) {
    source.rowRange(0, layout.height).copyTo(target);
  } else {
    cv::cvtColor(source, target, conversionOf(layout.format, encoding));
  }
  return {};
}

}  // namespace stereo_nav::camera
