#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace stereo_nav {

/// Gives arbitrary bytes to the reader of one kind of input: `ros`, `opencv`, `kalibr`, `kitti`, `euroc`,
/// `rig`, `times`, `lists`, `names` or `bag`. Refusals (InputError, ParameterError) are fine; any other
/// exception passes through: used by the fuzzer, and on its corpus by a unit test.
void readFuzzInput(const std::string& kind, const std::uint8_t* data, std::size_t size);

}  // namespace stereo_nav
