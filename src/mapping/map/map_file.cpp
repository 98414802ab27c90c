#include "mapping/map/map_file.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/atomic_file.h"
#include "mapping/map/byte_stream.h"
#include "mapping/map/map_sections.h"

namespace stereo_nav::mapping {
namespace {

constexpr char kMagic[] = "SNAVMAP\n";
constexpr std::size_t kMagicBytes = 8, kHeadBytes = kMagicBytes + 4;
constexpr std::uint32_t kVersion = 1;

std::uint32_t checksum(const std::string& name, const char* data, std::size_t size) {
  const auto* bytes = reinterpret_cast<const Bytef*>(data);
  const uLong of_name = crc32_z(0, reinterpret_cast<const Bytef*>(name.data()), name.size());
  return static_cast<std::uint32_t>(crc32_z(of_name, bytes, size));
}

void readHead(ByteReader& reader, const std::string& bytes, const std::string& path) {
  if (bytes.compare(0, kMagicBytes, kMagic) != 0)
    throw InputError(path + ": does not begin as a map does; is it a file of another kind?");
  reader.take(kMagicBytes);
  const auto version = reader.integer<std::uint32_t>();
  if (reader.integer<std::uint32_t>() != checksum("", bytes.data(), kHeadBytes))
    reader.fail("the head's checksum is wrong");
  if (version != kVersion)
    throw InputError(path + ": a map of version " + std::to_string(version) + ", version " +
                     std::to_string(kVersion) +
                     " can be read; use the program that wrote it, or make the map anew");
}

}  // namespace

std::string toBytes(const VisualMap& map) {
  ByteWriter head;
  for (std::size_t i = 0; i < kMagicBytes; ++i) head.integer(static_cast<std::uint8_t>(kMagic[i]));
  head.integer(kVersion);
  head.integer(checksum("", head.bytes().data(), kHeadBytes));
  std::string bytes = head.bytes();
  for (const MapSection& section : mapSections()) {
    ByteWriter content, frame;
    section.write(map, content);
    frame.integer(static_cast<std::uint64_t>(content.bytes().size()));
    frame.integer(checksum(section.name, content.bytes().data(), content.bytes().size()));
    bytes += frame.bytes() + content.bytes();
  }
  return bytes;
}

VisualMap mapOfBytes(const std::string& bytes, const std::string& path) {
  ByteReader head(bytes.data(), bytes.size(), path + ": head");
  readHead(head, bytes, path);
  std::size_t position = bytes.size() - head.left();
  VisualMap map;
  for (const MapSection& section : mapSections()) {
    const std::string name = path + ": section '" + section.name + "'";
    ByteReader frame(bytes.data() + position, bytes.size() - position, name);
    const auto size = frame.integer<std::uint64_t>();
    const auto sum = frame.integer<std::uint32_t>();
    if (size > frame.left()) frame.fail("it ends too early");
    const char* content = frame.take(static_cast<std::size_t>(size));
    if (checksum(section.name, content, static_cast<std::size_t>(size)) != sum)
      frame.fail("its checksum is wrong");
    ByteReader reader(content, static_cast<std::size_t>(size), name);
    section.read(reader, map);
    reader.requireEnd();
    position = bytes.size() - frame.left();
  }
  if (position != bytes.size())
    ByteReader(bytes.data() + position, bytes.size() - position, path + ": after section 'world'")
        .requireEnd();
  return map;
}

void saveMap(const VisualMap& map, const std::string& path) {
  writeFileAtomically(path, toBytes(map));
}

VisualMap loadMap(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InputError(path + ": cannot be read; is the name of the map right?");
  return mapOfBytes({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}, path);
}

}  // namespace stereo_nav::mapping
