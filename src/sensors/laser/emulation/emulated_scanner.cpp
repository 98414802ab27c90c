#include "sensors/laser/emulation/emulated_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereo_nav::laser {
namespace {

constexpr std::uint8_t kSync = 0xA5;
constexpr std::uint8_t kQuality = 47;
constexpr double kRadians = M_PI / 180.0;

std::vector<std::uint8_t> reply(rplidar::Command command, const std::vector<std::uint8_t>& payload) {
  const rplidar::Descriptor descriptor = rplidar::descriptor(command);
  std::vector<std::uint8_t> bytes(descriptor.size() + payload.size());
  std::copy(payload.begin(), payload.end(), std::copy(descriptor.begin(), descriptor.end(), bytes.begin()));
  return bytes;
}

}  // namespace

std::vector<EmulatedScanner::Output> EmulatedScanner::receive(const std::vector<std::uint8_t>& bytes,
                                                              double time_s) {
  std::vector<Output> replies;
  for (const std::uint8_t byte : bytes) {
    if (sync_seen_) {
      auto answer = obey(static_cast<rplidar::Command>(byte), time_s);
      if (!answer.empty()) replies.push_back({time_s, std::move(answer)});
      sync_seen_ = false;
    } else {
      sync_seen_ = byte == kSync;
    }
  }
  return replies;
}

std::vector<std::uint8_t> EmulatedScanner::obey(rplidar::Command command, double time_s) {
  switch (command) {
    case rplidar::Command::kReset:
      options_.error_code = 0;
      scanning_ = false;
      break;
    case rplidar::Command::kStop:
      scanning_ = false;
      break;
    case rplidar::Command::kGetInfo: {
      DeviceInfo info;
      info.model = 0x18;  // the A1M8
      info.firmware_major = 1;
      info.firmware_minor = 29;
      info.hardware = 7;
      info.serial_number.fill(0xE5);
      return reply(command, rplidar::encodeInfo(info));
    }
    case rplidar::Command::kGetHealth: {
      DeviceHealth health;
      if (options_.error_code != 0) health = {DeviceHealth::Status::kError, options_.error_code};
      return reply(command, rplidar::encodeHealth(health));
    }
    case rplidar::Command::kScan:
      if (options_.error_code != 0) break;
      scanning_ = true;
      next_sample_ = static_cast<std::uint64_t>(std::ceil(time_s * options_.sample_rate_hz));
      last_heading_deg_ = 360.0;
      return reply(command, {});
  }
  return {};
}

std::vector<EmulatedScanner::Output> EmulatedScanner::advance(double time_s) {
  std::vector<Output> nodes;
  while (scanning_) {
    const double sample_s = static_cast<double>(next_sample_) / options_.sample_rate_hz;
    if (sample_s > time_s) break;
    ++next_sample_;
    std::vector<std::uint8_t> bytes(rplidar::kNodeBytes);
    rplidar::encodeNode(measure(sample_s), bytes.data());
    nodes.push_back({sample_s, std::move(bytes)});
  }
  return nodes;
}

ScanNode EmulatedScanner::measure(double time_s) {
  ScanNode node;
  node.heading_deg = heading_deg(time_s);
  node.start = node.heading_deg < last_heading_deg_;
  last_heading_deg_ = node.heading_deg;
  if (std::uniform_real_distribution<double>()(random_) < options_.missing_share) return node;
  node.quality = kQuality;
  node.distance_mm =
      1e3 * (distance_m(node.heading_deg) + options_.noise_m * std::normal_distribution<double>()(random_));
  return node;
}

double EmulatedScanner::heading_deg(double time_s) const {
  const double turns = time_s * options_.scan_rate_hz;
  return 360.0 * (turns - std::floor(turns));
}

double EmulatedScanner::distance_m(double heading_deg) const {
  const double along = std::abs(std::cos(heading_deg * kRadians));
  const double across = std::abs(std::sin(heading_deg * kRadians));
  const double infinity = std::numeric_limits<double>::infinity();
  return std::min(along > 0.0 ? 0.5 * options_.room_length_m / along : infinity,
                  across > 0.0 ? 0.5 * options_.room_width_m / across : infinity);
}

}  // namespace stereo_nav::laser
