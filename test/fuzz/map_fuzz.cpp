#include "fuzz/map_fuzz.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "mapping/map/byte_stream.h"
#include "mapping/map/map_file.h"
#include "mapping/map/map_sections.h"

namespace stereo_nav::mapping {
namespace {

std::uint32_t checksumOf(const std::string& bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string framedSections(const std::uint8_t* data, std::size_t size) {
  std::string file = toBytes(VisualMap()).substr(0, 16);
  for (const MapSection& section : mapSections()) {
    const std::size_t asked = size < 2 ? 0 : data[0] + 256U * data[1];
    const std::size_t skip = std::min<std::size_t>(2, size), length = std::min(asked, size - skip);
    const std::string content(reinterpret_cast<const char*>(data) + skip, length);
    ByteWriter frame;
    frame.integer(static_cast<std::uint64_t>(length));
    frame.integer(checksumOf(section.name + content));
    file += frame.bytes() + content;
    data += skip + length;
    size -= skip + length;
  }
  return file;
}

}  // namespace

void loadFuzzInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const std::string file = data[0] % 2 == 1 ? framedSections(data + 1, size - 1)
                                            : std::string(reinterpret_cast<const char*>(data) + 1, size - 1);
  VisualMap map;
  try {
    map = mapOfBytes(file, "fuzz");
  } catch (const InputError&) {
    return;
  }
  const std::string saved = toBytes(map);
  if (toBytes(mapOfBytes(saved, "fuzz")) != saved) std::abort();
}

}  // namespace stereo_nav::mapping
