// The seeds of the fuzzer, and what it has found.
#include "fuzz/map_fuzz.h"

#include <gtest/gtest.h>

#include "unit/mapping/map/map_scene.h"

namespace stereo_nav::mapping {
namespace {

void load(const std::string& bytes) {
  loadFuzzInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

TEST(MapFuzz, TakesWholeFilesAndSectionsAlone) {
  load("");
  load("0" + toBytes(smallMap()));
  load("1");
  const std::string bytes = toBytes(smallMap());
  std::string sections = "1";
  for (std::size_t at = 16;
       at < bytes.size();) {  // length (u64, here two bytes of it), checksum (u32), content
    const std::size_t length =
        static_cast<std::uint8_t>(bytes[at]) + 256U * static_cast<std::uint8_t>(bytes[at + 1]);
    sections += bytes.substr(at, 2) + bytes.substr(at + 12, length);
    at += 12 + length;
  }
  load(sections);
}

}  // namespace
}  // namespace stereo_nav::mapping
