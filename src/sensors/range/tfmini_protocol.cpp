#include "sensors/range/tfmini_protocol.h"

#include <algorithm>
#include <numeric>

#include "sensors/serial/little_endian.h"

namespace stereo_nav::range {
namespace {

constexpr std::uint8_t kSync = 0x59;

std::uint8_t checkSum(const std::uint8_t* frame) {
  return static_cast<std::uint8_t>(std::accumulate(frame, frame + tfmini::kFrameBytes - 1, 0U));
}

}  // namespace

void tfmini::encode(const TfminiMeasurement& measurement, std::uint8_t* frame) {
  frame[0] = frame[1] = kSync;
  serial::writeUnsigned(measurement.distance_cm, frame + 2);
  serial::writeUnsigned(measurement.strength, frame + 4);
  serial::writeUnsigned(measurement.temperature, frame + 6);
  frame[8] = checkSum(frame);
}

void TfminiParser::reset() {
  size_ = skipped_ = 0;
  first_ = true;
}

std::optional<TfminiFrame> TfminiParser::push(std::uint8_t byte) {
  buffer_[size_++] = byte;
  ++counters_.bytes;
  while (true) {
    while (size_ > 0 && !headerAt(0)) dropByte();
    if (size_ < tfmini::kFrameBytes) return std::nullopt;
    if (!good()) {
      ++counters_.bad_frames;
      dropByte();
      continue;
    }
    const bool behind_another = !first_ && skipped_ == 0;
    if (behind_another) return take();
    // The header behind it decides, of which two bytes, one or none have come.
    if (size_ > tfmini::kFrameBytes && !headerAt(tfmini::kFrameBytes)) {
      dropByte();
      continue;
    }
    if (size_ < buffer_.size()) return std::nullopt;
    return take();
  }
}

/// Whether a header, or the part of it that has arrived, stands there.
bool TfminiParser::headerAt(std::size_t offset) const {
  return buffer_[offset] == kSync && (offset + 1 >= size_ || buffer_[offset + 1] == kSync);
}

bool TfminiParser::good() const {
  const auto distance_cm = serial::readUnsigned<std::uint16_t>(&buffer_[2]);
  return checkSum(buffer_.data()) == buffer_[tfmini::kFrameBytes - 1] &&
         (distance_cm <= tfmini::kMaxDistance_cm || distance_cm >= tfmini::kFirstCode);
}

TfminiFrame TfminiParser::take() {
  const std::size_t lost = first_ ? 0 : (skipped_ + tfmini::kFrameBytes - 1) / tfmini::kFrameBytes;
  index_ += lost + 1;
  counters_.lost += lost;
  ++counters_.frames;
  TfminiFrame frame;
  frame.measurement.distance_cm = serial::readUnsigned<std::uint16_t>(&buffer_[2]);
  frame.measurement.strength = serial::readUnsigned<std::uint16_t>(&buffer_[4]);
  frame.measurement.temperature = serial::readUnsigned<std::uint16_t>(&buffer_[6]);
  frame.index = index_;
  frame.last_byte = counters_.bytes - size_ + tfmini::kFrameBytes - 1;
  std::copy(buffer_.begin() + tfmini::kFrameBytes, buffer_.begin() + static_cast<std::ptrdiff_t>(size_),
            buffer_.begin());
  size_ -= tfmini::kFrameBytes;
  skipped_ = 0;
  first_ = false;
  return frame;
}

void TfminiParser::dropByte() {
  std::copy(buffer_.begin() + 1, buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  --size_;
  ++skipped_;
  ++counters_.bytes_skipped;
}

}  // namespace stereo_nav::range
