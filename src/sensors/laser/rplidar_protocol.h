#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::laser {

/// One sample of the scanner.
struct ScanNode {
  bool start = false;        ///< the first one of a revolution
  std::uint8_t quality = 0;  ///< 0 to 63, strength of the reflection
  double heading_deg = 0.0;  ///< from the device's own zero, clockwise seen from above, [0, 360)
  double distance_mm = 0.0;  ///< from the centre of rotation; 0: there is no valid measurement
};

struct DeviceInfo {
  std::uint8_t model = 0;
  std::uint8_t firmware_major = 0, firmware_minor = 0;
  std::uint8_t hardware = 0;
  std::array<std::uint8_t, 16> serial_number{};

  std::string text() const;
};

struct DeviceHealth {
  enum class Status : std::uint8_t { kGood = 0, kWarning = 1, kError = 2 };
  Status status = Status::kGood;
  std::uint16_t error_code = 0;
};

/// The serial protocol of Slamtec's RPLiDAR A1 ("Interface Protocol and Application Notes", rev. 1.1),
/// without the express scan. All numbers are little-endian.
///
/// A request is 0xA5 and a command. A reply is a descriptor, 0xA5 0x5A, 30 bits of length, 2 bits of mode (1:
/// many packets follow) and a type; then the data. What a scan sends are nodes of 5 bytes:
///
/// | byte | content |
/// |---|---|
/// | 0 | bit 0: S, first node of a revolution; bit 1: not S; bits 2 to 7: quality |
/// | 1 | bit 0: always 1; bits 1 to 7: low bits of the heading in 1/64 deg |
/// | 2 | high bits of the heading |
/// | 3, 4 | distance in 1/4 mm |
namespace rplidar {

enum class Command : std::uint8_t {
  kStop = 0x25,
  kReset = 0x40,
  kScan = 0x20,
  kGetInfo = 0x50,
  kGetHealth = 0x52
};

constexpr std::size_t kNodeBytes = 5;
constexpr std::size_t kRequestBytes = 2;
constexpr std::size_t kDescriptorBytes = 7;
constexpr std::size_t kInfoBytes = 20;
constexpr std::size_t kHealthBytes = 3;

using Descriptor = std::array<std::uint8_t, kDescriptorBytes>;

std::array<std::uint8_t, kRequestBytes> request(Command command);
/// The descriptor of the reply to a command that has one: kScan, kGetInfo, kGetHealth.
Descriptor descriptor(Command command);

/// Nothing when a check bit is wrong or the heading is 360 degrees or more.
std::optional<ScanNode> decodeNode(const std::uint8_t* bytes);
/// Writes kNodeBytes. Heading and distance are rounded to the protocol's resolution.
void encodeNode(const ScanNode& node, std::uint8_t* bytes);

DeviceInfo decodeInfo(const std::uint8_t* bytes);
std::vector<std::uint8_t> encodeInfo(const DeviceInfo& info);
DeviceHealth decodeHealth(const std::uint8_t* bytes);
std::vector<std::uint8_t> encodeHealth(const DeviceHealth& health);

}  // namespace rplidar
}  // namespace stereo_nav::laser
