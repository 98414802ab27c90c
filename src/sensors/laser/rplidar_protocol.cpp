#include "sensors/laser/rplidar_protocol.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "sensors/serial/little_endian.h"

namespace stereo_nav::laser {
namespace {

constexpr std::uint8_t kRequestSync = 0xA5;
constexpr double kHeadingsPerDegree = 64.0;
constexpr double kDistancesPerMillimetre = 4.0;
constexpr unsigned kFullTurn = 360 * 64;

}  // namespace

std::string DeviceInfo::text() const {
  std::ostringstream text;
  text << "model " << int{model} << ", firmware " << int{firmware_major} << "." << std::setw(2)
       << std::setfill('0') << int{firmware_minor} << ", hardware " << int{hardware} << ", serial number "
       << std::hex << std::uppercase;
  for (const std::uint8_t byte : serial_number) text << std::setw(2) << int{byte};
  return text.str();
}

namespace rplidar {

std::array<std::uint8_t, kRequestBytes> request(Command command) {
  return {kRequestSync, static_cast<std::uint8_t>(command)};
}

Descriptor descriptor(Command command) {
  switch (command) {
    case Command::kScan:
      return {0xA5, 0x5A, kNodeBytes, 0x00, 0x00, 0x40, 0x81};
    case Command::kGetInfo:
      return {0xA5, 0x5A, kInfoBytes, 0x00, 0x00, 0x00, 0x04};
    case Command::kGetHealth:
      return {0xA5, 0x5A, kHealthBytes, 0x00, 0x00, 0x00, 0x06};
    case Command::kStop:
    case Command::kReset:
      break;
  }
  return {};
}

std::optional<ScanNode> decodeNode(const std::uint8_t* bytes) {
  const bool start = (bytes[0] & 1U) != 0;
  const bool not_start = (bytes[0] & 2U) != 0;
  const unsigned heading = serial::readUnsigned<std::uint16_t>(bytes + 1) >> 1;
  if (start == not_start || (bytes[1] & 1U) == 0 || heading >= kFullTurn) return std::nullopt;
  ScanNode node;
  node.start = start;
  node.quality = static_cast<std::uint8_t>(bytes[0] >> 2);
  node.heading_deg = heading / kHeadingsPerDegree;
  node.distance_mm = serial::readUnsigned<std::uint16_t>(bytes + 3) / kDistancesPerMillimetre;
  return node;
}

void encodeNode(const ScanNode& node, std::uint8_t* bytes) {
  const auto heading = static_cast<unsigned>(std::lround(node.heading_deg * kHeadingsPerDegree)) % kFullTurn;
  const double distance = std::clamp(std::round(node.distance_mm * kDistancesPerMillimetre), 0.0, 65535.0);
  bytes[0] = static_cast<std::uint8_t>((node.quality << 2) | (node.start ? 1 : 2));
  serial::writeUnsigned(static_cast<std::uint16_t>((heading << 1) | 1U), bytes + 1);
  serial::writeUnsigned(static_cast<std::uint16_t>(distance), bytes + 3);
}

DeviceInfo decodeInfo(const std::uint8_t* bytes) {
  DeviceInfo info;
  info.model = bytes[0];
  info.firmware_minor = bytes[1];
  info.firmware_major = bytes[2];
  info.hardware = bytes[3];
  std::copy(bytes + 4, bytes + kInfoBytes, info.serial_number.begin());
  return info;
}

std::vector<std::uint8_t> encodeInfo(const DeviceInfo& info) {
  std::vector<std::uint8_t> bytes(kInfoBytes);
  bytes[0] = info.model;
  bytes[1] = info.firmware_minor;
  bytes[2] = info.firmware_major;
  bytes[3] = info.hardware;
  std::copy(info.serial_number.begin(), info.serial_number.end(), bytes.begin() + 4);
  return bytes;
}

DeviceHealth decodeHealth(const std::uint8_t* bytes) {
  DeviceHealth health;
  health.status = static_cast<DeviceHealth::Status>(std::min<std::uint8_t>(bytes[0], 2));
  health.error_code = serial::readUnsigned<std::uint16_t>(bytes + 1);
  return health;
}

std::vector<std::uint8_t> encodeHealth(const DeviceHealth& health) {
  return {static_cast<std::uint8_t>(health.status), static_cast<std::uint8_t>(health.error_code & 0xFFU),
          static_cast<std::uint8_t>(health.error_code >> 8)};
}

}  // namespace rplidar
}  // namespace stereo_nav::laser
