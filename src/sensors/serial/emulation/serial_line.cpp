#include "sensors/serial/emulation/serial_line.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::serial {

bool LineFaults::pass(const std::uint8_t* bytes, std::size_t size, std::vector<std::uint8_t>& out) {
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  std::uniform_int_distribution<int> difference(1, 255);
  bool intact = true;
  for (std::size_t i = 0; i < size; ++i) {
    const double draw = chance(random_);
    if (draw < drop_probability_) {
      intact = false;
    } else if (draw < drop_probability_ + corrupt_probability_) {
      out.push_back(static_cast<std::uint8_t>(bytes[i] ^ difference(random_)));
      intact = false;
    } else {
      out.push_back(bytes[i]);
    }
  }
  return intact;
}

void SerialLine::send(const std::vector<std::uint8_t>& bytes, double time_s) {
  free_s_ = std::max(free_s_, time_s);
  for (const std::uint8_t byte : bytes) {
    free_s_ += byte_time_s_;
    bytes_.push_back({free_s_, byte});
  }
}

double SerialLine::backlog_s(double time_s) const {
  return std::max(0.0, free_s_ - time_s);
}

void SerialLine::collect(double time_s, std::vector<std::uint8_t>& out) {
  const double handover_s = batch_s_ > 0.0 ? std::floor(time_s / batch_s_) * batch_s_ : time_s;
  while (!bytes_.empty() && bytes_.front().arrival_s <= handover_s) {
    out.push_back(bytes_.front().value);
    bytes_.pop_front();
  }
}

bool MismatchedReceiver::level(double bit_time) const {
  return levels_[static_cast<std::size_t>(bit_time)];
}

void MismatchedReceiver::receive(const std::vector<std::uint8_t>& bytes, std::vector<std::uint8_t>& out) {
  for (const std::uint8_t byte : bytes) {
    levels_.push_back(false);
    for (int bit = 0; bit < 8; ++bit) levels_.push_back(((byte >> bit) & 1) != 0);
    levels_.push_back(true);
  }
  while (true) {
    while (known(position_) && level(position_)) position_ = std::floor(position_) + 1.0;
    if (!known(position_ + 9.5 * receiver_bit_)) break;
    unsigned value = 0;
    for (int bit = 0; bit < 8; ++bit) {
      value |= static_cast<unsigned>(level(position_ + (1.5 + bit) * receiver_bit_)) << bit;
    }
    const bool stop = level(position_ + 9.5 * receiver_bit_);
    out.push_back(static_cast<std::uint8_t>(stop ? value : 0U));
    position_ += 9.5 * receiver_bit_;
  }
  const auto consumed = std::min(static_cast<std::size_t>(position_), levels_.size());
  levels_.erase(levels_.begin(), levels_.begin() + static_cast<std::ptrdiff_t>(consumed));
  position_ -= static_cast<double>(consumed);
}

}  // namespace stereo_nav::serial
