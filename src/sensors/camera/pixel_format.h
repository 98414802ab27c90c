#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace stereo_nav::camera {

/// Pixel formats that cameras deliver and the decoder understands. kAny asks for the best that the camera
/// has.
enum class PixelFormat { kAny, kMjpg, kYuyv, kUyvy, kGrey, kNv12 };

/// V4L2's four-character code; 0 for kAny.
std::uint32_t fourccOf(PixelFormat format);

/// kAny when the code is none of these formats.
PixelFormat pixelFormatOf(std::uint32_t fourcc);

/// A code in readable form, e.g. "MJPG".
std::string fourccText(std::uint32_t fourcc);

/// Bytes of a full image with lines of `bytes_per_line`; 0 for compressed formats.
std::size_t imageBytes(PixelFormat format, int height, std::size_t bytes_per_line);

/// The shortest line that holds `width` pixels; 0 for compressed formats.
std::size_t minimumBytesPerLine(PixelFormat format, int width);

}  // namespace stereo_nav::camera
