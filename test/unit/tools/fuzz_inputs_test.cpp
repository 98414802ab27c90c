// Inputs that a fuzzer found worth keeping, and bits of them: none ends the process by a signal or an
// exception.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "fuzz/device_fuzz.h"
#include "fuzz/input_fuzz.h"

namespace stereo_nav::tools {
namespace {

class FuzzInputs : public ::testing::TestWithParam<const char*> {};

void readBytes(const std::string& kind, const std::string& bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (!decodeFuzzInput(kind, data, bytes.size())) readFuzzInput(kind, data, bytes.size());
}

TEST_P(FuzzInputs, AreReadOrRefused) {
  const std::string kind = GetParam();
  const std::string folder = std::string(STEREO_NAV_SOURCE_DIR) + "/test/fuzz/corpus/" + kind;
  std::mt19937 random(1);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    ASSERT_FALSE(bytes.empty()) << entry.path();
    EXPECT_NO_THROW(readBytes(kind, bytes)) << entry.path();
    for (int i = 0; i < 20; ++i) {
      std::string changed = bytes;
      changed[random() % bytes.size()] = static_cast<char>(random());
      changed.erase(random() % bytes.size(), random() % 9);
      EXPECT_NO_THROW(readBytes(kind, changed)) << entry.path() << ", change " << i;
    }
    ++files;
  }
  EXPECT_GT(files, 0U);
}

INSTANTIATE_TEST_SUITE_P(Corpus, FuzzInputs,
                         ::testing::Values("ros", "opencv", "kalibr", "kitti", "euroc", "rig", "times",
                                           "lists", "names", "bag", "angles", "raw", "raw_udp", "phone",
                                           "laser", "tfmini", "base"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace stereo_nav::tools
