#include "stereo_nav/sensors/imu/raw_protocol.h"

#include <algorithm>
#include <cmath>

#include "sensors/serial/crc32.h"
#include "sensors/serial/little_endian.h"

namespace stereo_nav::imu {
namespace {

constexpr std::uint8_t kSync0 = 0xA5;
constexpr std::uint8_t kSync1 = 0x5A;
constexpr std::uint8_t kTypeInertial = 1;
constexpr std::uint8_t kTypeWithMagnetometer = 2;

// Values beyond what any module of this class can measure (4000 deg/s, 32 g, 100 times the earth's field).
constexpr double kMaxRate_rad_s = 70.0;
constexpr double kMaxAcceleration_m_s2 = 320.0;
constexpr double kMaxField_uT = 5000.0;

/// A larger gap in the sequence means that the module was restarted.
constexpr std::uint16_t kRestartGap = 10000;

std::size_t payloadBytes(std::uint8_t type) {
  if (type == kTypeInertial) return raw_protocol::kPayloadBytes;
  if (type == kTypeWithMagnetometer) return raw_protocol::kPayloadBytesWithMagnetometer;
  return 0;
}

void writeVector(const Eigen::Vector3d& v, std::uint8_t* bytes) {
  for (int i = 0; i < 3; ++i) serial::writeFloat(static_cast<float>(v[i]), bytes + 4 * i);
}

Eigen::Vector3d readVector(const std::uint8_t* bytes) {
  return Eigen::Vector3f(serial::readFloat(bytes), serial::readFloat(bytes + 4), serial::readFloat(bytes + 8))
      .cast<double>();
}

bool within(const Eigen::Vector3d& v, double limit) {
  return std::abs(v.x()) <= limit && std::abs(v.y()) <= limit && std::abs(v.z()) <= limit;  // false for NaN
}

RawMeasurement decodePayload(const std::uint8_t* payload, bool with_magnetometer) {
  RawMeasurement measurement;
  measurement.sequence = serial::readUnsigned<std::uint16_t>(payload);
  measurement.device_time_us = serial::readUnsigned<std::uint32_t>(payload + 2);
  measurement.angular_velocity = readVector(payload + 6);
  measurement.linear_acceleration = readVector(payload + 18);
  if (with_magnetometer) measurement.magnetic_field = readVector(payload + 30);
  return measurement;
}

}  // namespace

std::size_t raw_protocol::encode(const RawMeasurement& measurement, std::uint8_t* frame) {
  const std::uint8_t type = measurement.magnetic_field ? kTypeWithMagnetometer : kTypeInertial;
  const std::size_t payload_bytes = payloadBytes(type);
  frame[0] = kSync0;
  frame[1] = kSync1;
  frame[2] = type;
  frame[3] = static_cast<std::uint8_t>(payload_bytes);
  std::uint8_t* payload = frame + kPrefixBytes;
  serial::writeUnsigned(measurement.sequence, payload);
  serial::writeUnsigned(measurement.device_time_us, payload + 2);
  writeVector(measurement.angular_velocity, payload + 6);
  writeVector(measurement.linear_acceleration, payload + 18);
  if (measurement.magnetic_field) writeVector(*measurement.magnetic_field, payload + 30);
  serial::writeUnsigned(serial::crc32(frame + 2, 2 + payload_bytes), payload + payload_bytes);
  return kPrefixBytes + payload_bytes + kCrcBytes;
}

bool raw_protocol::possible(const RawMeasurement& measurement) {
  return within(measurement.angular_velocity, kMaxRate_rad_s) &&
         within(measurement.linear_acceleration, kMaxAcceleration_m_s2) &&
         (!measurement.magnetic_field || within(*measurement.magnetic_field, kMaxField_uT));
}

void RawParser::reset() {
  size_ = 0;
  last_sequence_.reset();
}

std::optional<RawFrame> RawParser::push(std::uint8_t byte) {
  buffer_[size_++] = byte;
  ++counters_.bytes;
  while (true) {
    alignToPrefix();
    if (size_ < raw_protocol::kPrefixBytes) return std::nullopt;
    const std::size_t frame_bytes =
        raw_protocol::kPrefixBytes + payloadBytes(buffer_[2]) + raw_protocol::kCrcBytes;
    if (size_ < frame_bytes) return std::nullopt;
    if (auto frame = takeFrame(frame_bytes)) return frame;
  }
}

/// Drops bytes that cannot begin a frame.
void RawParser::alignToPrefix() {
  while (size_ > 0 && !prefixAtFront()) skip();
}

bool RawParser::prefixAtFront() const {
  if (buffer_[0] != kSync0) return false;
  if (size_ > 1 && buffer_[1] != kSync1) return false;
  if (size_ > 2 && payloadBytes(buffer_[2]) == 0) return false;
  return size_ <= 3 || buffer_[3] == payloadBytes(buffer_[2]);
}

std::optional<RawFrame> RawParser::takeFrame(std::size_t frame_bytes) {
  const std::size_t checked_bytes = frame_bytes - 2 - raw_protocol::kCrcBytes;
  if (serial::crc32(&buffer_[2], checked_bytes) !=
      serial::readUnsigned<std::uint32_t>(&buffer_[2 + checked_bytes])) {
    ++counters_.bad_crc;
    skip();
    return std::nullopt;
  }
  RawFrame frame;
  frame.measurement =
      decodePayload(&buffer_[raw_protocol::kPrefixBytes], buffer_[2] == kTypeWithMagnetometer);
  frame.last_byte = counters_.bytes - size_ + frame_bytes - 1;
  drop(frame_bytes);
  countLost(frame.measurement.sequence);
  if (!raw_protocol::possible(frame.measurement)) {
    ++counters_.impossible;
    return std::nullopt;
  }
  ++counters_.delivered;
  return frame;
}

void RawParser::countLost(std::uint16_t sequence) {
  if (last_sequence_) {
    const auto gap = static_cast<std::uint16_t>(sequence - *last_sequence_ - 1);
    if (gap < kRestartGap) counters_.lost += gap;
  }
  last_sequence_ = sequence;
}

void RawParser::skip() {
  ++counters_.bytes_skipped;
  drop(1);
}

void RawParser::drop(std::size_t count) {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(count),
            buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  size_ -= count;
}

}  // namespace stereo_nav::imu
