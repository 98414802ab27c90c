// libFuzzer target of scripts/fuzz.sh; STEREO_NAV_FUZZ_KIND in the environment says which reader it tries.
#include <cstdlib>

#include "fuzz/input_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const kind = std::getenv("STEREO_NAV_FUZZ_KIND");
  if (kind == nullptr) std::abort();
  stereo_nav::readFuzzInput(kind, data, size);
  return 0;
}
