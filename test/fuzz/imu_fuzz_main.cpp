// libFuzzer target; scripts/fuzz_imu.sh builds it once for each protocol.
#include "fuzz/imu_decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  stereo_nav::imu::decodeFuzzInput(stereo_nav::imu::Protocol::STEREO_NAV_FUZZ_PROTOCOL, data, size);
  return 0;
}
