// libFuzzer target of scripts/fuzz.sh map.
#include "fuzz/map_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  stereo_nav::mapping::loadFuzzInput(data, size);
  return 0;
}
