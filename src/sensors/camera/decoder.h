#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "sensors/camera/pixel_format.h"

namespace stereo_nav::camera {

/// What the decoder makes: names as in ROS image encodings.
enum class Encoding { Mono8, Bgr8 };

/// As in ROS image messages: mono8 or bgr8.
std::string encodingName(Encoding encoding);

/// A decoded image, rows packed without padding (step = width * channels), so that its bytes can be moved
/// into a message without a copy.
struct DecodedImage {
  int width = 0;
  int height = 0;
  Encoding encoding = Encoding::Mono8;
  std::vector<std::uint8_t> pixels;

  int channels() const { return encoding == Encoding::Mono8 ? 1 : 3; }
  std::size_t step() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels()); }
  /// A header onto `pixels`, valid as long as they are.
  cv::Mat view();
};

/// The layout in which a camera delivers.
struct ImageLayout {
  PixelFormat format = PixelFormat::Any;
  int width = 0;
  int height = 0;
  std::size_t bytes_per_line = 0;  ///< 0 for compressed formats
};

/// Gives `image` the memory that decoding this layout takes, ahead of the image: a megabyte fresh from the
/// system costs as much as a tenth of decoding a JPEG into it.
void allocate(const ImageLayout& layout, Encoding encoding, DecodedImage& image);

/// Decodes one image. Returns an empty text, or what is wrong with the data (then `image` is not to be used).
/// A JPEG must have the layout's size and be complete; bytes between its markers are let pass, since many
/// webcams fill up with them. A JPEG without Huffman tables (usual for MJPG) gets the standard ones.
std::string decode(const std::uint8_t* data, std::size_t size, const ImageLayout& layout, Encoding encoding,
                   DecodedImage& image);

}  // namespace stereo_nav::camera
