#pragma once

#include <cstddef>
#include <cstdint>

namespace stereo_nav::mapping {

/// Gives arbitrary bytes to the loader of maps and aborts when it throws anything but InputError, or when
/// what it takes does not give the same bytes after a second save and load. Where the first byte is odd, the
/// rest is cut into sections that get a right head, right lengths and checksums, so that the fuzzer reaches
/// what lies behind them: each section begins with its length (u16).
void loadFuzzInput(const std::uint8_t* data, std::size_t size);

}  // namespace stereo_nav::mapping
