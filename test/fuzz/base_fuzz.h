#pragma once

#include <cstddef>
#include <cstdint>

namespace stereo_nav::base {

/// Gives arbitrary bytes to the parsers of both directions and aborts when the result breaks a promise.
/// Where the first byte is odd, the rest is cut into payloads that get a right header and check sum, so that
/// the fuzzer reaches what lies behind them.
void parseFuzzInput(const std::uint8_t* data, std::size_t size);

}  // namespace stereo_nav::base
