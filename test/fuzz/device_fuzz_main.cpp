// libFuzzer target of scripts/fuzz.sh; STEREO_NAV_FUZZ_KIND in the environment says which decoder it tries.
#include <cstdlib>

#include "fuzz/device_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const kind = std::getenv("STEREO_NAV_FUZZ_KIND");
  if (kind == nullptr || !stereo_nav::decodeFuzzInput(kind, data, size)) std::abort();
  return 0;
}
