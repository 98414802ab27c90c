#pragma once

#include <string>

#include "sensors/camera/decoder.h"

namespace stereo_nav::camera::internal {

/// Does for MJPG what `decode` does.
std::string decodeJpeg(const std::uint8_t* data, std::size_t size, const ImageLayout& layout,
                       Encoding encoding, DecodedImage& image);

}  // namespace stereo_nav::camera::internal
