#include "sensors/imu/angle_protocol.h"

#include <algorithm>
#include <cmath>

#include "sensors/serial/little_endian.h"

namespace stereo_nav::imu {
namespace {

constexpr std::array<std::uint8_t, AngleFramer::kHeaderBytes> kHeader = {'i', 't', 's'};

/// Modules count yaw in either direction, from 0 to 360 or from -180 to 180.
constexpr double kMaxYaw_deg = 360.5;
constexpr double kMaxTilt_deg = 180.5;

bool possible(const ModuleAngles& angles) {
  const auto within = [](double angle, double limit) {
    return std::abs(angle) <= limit;  // false for NaN
  };
  return within(angles.yaw_deg, kMaxYaw_deg) && within(angles.pitch_deg, kMaxTilt_deg) &&
         within(angles.roll_deg, kMaxTilt_deg);
}

}  // namespace

void AngleFramer::reset() {
  size_ = 0;
  front_reported_ = false;
  last_first_byte_.reset();
}

std::optional<AngleCandidate> AngleFramer::push(std::uint8_t byte) {
  buffer_[size_++] = byte;
  ++counters_.bytes;
  while (true) {
    if (front_reported_ && !judgeSuccessor()) return std::nullopt;
    alignToHeader();
    if (size_ < kFrameBytes) return std::nullopt;
    if (auto candidate = decode()) return candidate;
    ++counters_.impossible;
    drop(1);
  }
}

/// Returns false while the bytes after the reported frame have not all come.
bool AngleFramer::judgeSuccessor() {
  if (size_ < kFrameBytes + kHeaderBytes) return false;
  front_reported_ = false;
  drop(headerAt(kFrameBytes, kHeaderBytes) ? kFrameBytes : 1);
  return true;
}

void AngleFramer::alignToHeader() {
  std::size_t offset = 0;
  while (offset < size_ && !headerAt(offset, size_ - offset)) ++offset;
  counters_.bytes_skipped += offset;
  drop(offset);
}

std::optional<AngleCandidate> AngleFramer::decode() {
  std::array<double, 3> value{};
  for (std::size_t i = 0; i < value.size(); ++i) {
    value[i] = static_cast<double>(serial::readFloat(&buffer_[kHeaderBytes + 4 * i]));
  }
  AngleCandidate candidate;
  candidate.angles = order_ == AngleOrder::kYawPitchRoll ? ModuleAngles{value[0], value[1], value[2]}
                                                         : ModuleAngles{value[2], value[1], value[0]};
  if (!possible(candidate.angles)) return std::nullopt;
  candidate.first_byte = counters_.bytes - size_;
  candidate.follows = last_first_byte_ && candidate.first_byte == *last_first_byte_ + kFrameBytes;
  last_first_byte_ = candidate.first_byte;
  front_reported_ = true;
  return candidate;
}

bool AngleFramer::headerAt(std::size_t offset, std::size_t available) const {
  const std::size_t count = std::min(available, kHeaderBytes);
  return std::equal(kHeader.begin(), kHeader.begin() + static_cast<std::ptrdiff_t>(count),
                    buffer_.begin() + static_cast<std::ptrdiff_t>(offset));
}

void AngleFramer::drop(std::size_t count) {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(count),
            buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  size_ -= count;
}

void encodeAngleFrame(const ModuleAngles& angles, AngleOrder order, std::uint8_t* frame) {
  const bool yaw_first = order == AngleOrder::kYawPitchRoll;
  std::copy(kHeader.begin(), kHeader.end(), frame);
  serial::writeFloat(static_cast<float>(yaw_first ? angles.yaw_deg : angles.roll_deg), frame + 3);
  serial::writeFloat(static_cast<float>(angles.pitch_deg), frame + 7);
  serial::writeFloat(static_cast<float>(yaw_first ? angles.roll_deg : angles.yaw_deg), frame + 11);
}

}  // namespace stereo_nav::imu
