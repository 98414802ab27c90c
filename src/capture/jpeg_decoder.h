#pragma once

#include <string>

#include "stereo_nav/capture/decoder.h"

namespace stereo_nav::capture::internal {

/// As `decode`, for MJPG.
std::string decodeJpeg(const std::uint8_t* data, std::size_t size, const ImageLayout& layout,
                       Encoding encoding, DecodedImage& image);

}  // namespace stereo_nav::capture::internal
