#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace stereo_nav {

/// Gives arbitrary bytes to the decoder of a device and aborts when the result breaks a promise. `kind`:
/// angles, raw (serial), raw_udp, phone, laser, tfmini, base (base_fuzz.h). The first byte says how the rest
/// is cut into reads, and how much time passes between them; the base has bytes one by one. Returns false
/// where there is no such kind.
bool decodeFuzzInput(const std::string& kind, const std::uint8_t* data, std::size_t size);

}  // namespace stereo_nav
