#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "sensors/camera/pixel_format.h"

namespace stereo_nav::camera {

/// The encodings that the decoder produces, named as in ROS image messages.
enum class Encoding { kMono8, kBgr8 };

/// The name in ROS image messages: mono8 or bgr8.
std::string encodingName(Encoding encoding);

/// A decoded image, rows packed without padding (step = width * channels), so that its bytes can be moved
/// into a message without a copy.
struct DecodedImage {
  int width = 0;
  int height = 0;
  Encoding encoding = Encoding::kMono8;
  std::vector<std::uint8_t> pixels;

  int channels() const { return encoding == Encoding::kMono8 ? 1 : 3; }
  std::size_t step() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels()); }
  /// A matrix header that refers to `pixels`; it is valid as long as they are.
  cv::Mat view();
};

/// The layout in which a camera delivers.
struct ImageLayout {
  PixelFormat format = PixelFormat::kAny;
  int width = 0;
  int height = 0;
  std::size_t bytes_per_line = 0;  ///< 0 for compressed formats
};

/// Gives `image` the memory that decoding this layout needs, before the image comes: a megabyte of new memory
/// costs as much as a tenth of decoding a JPEG into it.
void allocate(const ImageLayout& layout, Encoding encoding, DecodedImage& image);

/// Decodes one image. Returns an empty text, or what is wrong with the data; `image` must not be used then. A
/// JPEG must have the layout's size and be complete. Extra bytes between its markers are accepted, since many
/// webcams pad images with them. A JPEG without Huffman tables (usual for MJPG) gets the standard ones.
std::string decode(const std::uint8_t* data, std::size_t size, const ImageLayout& layout, Encoding encoding,
                   DecodedImage& image);

}  // namespace stereo_nav::camera
