#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/imu_decoder_fuzz.h"

namespace stereo_nav::imu {
namespace {

/// Inputs that a fuzzer found worth keeping; decodeFuzzInput() aborts when one breaks a promise.
void decodeCorpus(Protocol protocol, const std::string& name) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(STEREO_NAV_SOURCE_DIR) +
                                                               "/test/fuzz/corpus/" + name)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    decodeFuzzInput(protocol, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++files;
  }
  EXPECT_GT(files, 5U);
}

TEST(FuzzCorpus, Angles) {
  decodeCorpus(Protocol::kAngles, "angles");
}
TEST(FuzzCorpus, Raw) {
  decodeCorpus(Protocol::kRaw, "raw");
}

}  // namespace
}  // namespace stereo_nav::imu
