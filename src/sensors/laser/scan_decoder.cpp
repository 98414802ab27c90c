#include "sensors/laser/scan_decoder.h"

namespace stereo_nav::laser {
namespace {

/// Bits on the wire for a byte: start bit, eight data bits, stop bit.
constexpr double kBitsPerByte = 10.0;
/// Arrivals that are all late by half of this mean that nodes were lost without being noticed.
constexpr double kUnnoticedLoss_s = 0.002;

}  // namespace

ScanDecoder::ScanDecoder(const ScanParams& scan, const serial::StampFilterParams& stamps, int baud_rate,
                         double latency_s)
    : stamps_(stamps), assembler_(scan), byte_time_s_(kBitsPerByte / baud_rate), latency_s_(latency_s) {}

void ScanDecoder::push(const std::uint8_t* data, std::size_t size, double read_time_s,
                       const ScanAssembler::Sink& sink) {
  const double before_measured_s = rplidar::kNodeBytes * byte_time_s_ + latency_s_;
  for (std::size_t i = 0; i < size; ++i) {
    framer_.push(data[i], [&](const FramedNode& node) {
      if (node.restarted) stamps_.restartClock();
      const auto behind = static_cast<double>(framer_.counters().bytes - 1 - node.last_byte + (size - 1 - i));
      const double arrival_s = read_time_s - behind * byte_time_s_;
      const auto number = static_cast<double>(node.index);
      const double loss = kUnnoticedLoss_s / stamps_.slope().value_or(kUnnoticedLoss_s);
      const double sent_s = stamps_.stamp(number, loss, arrival_s);
      jitter_.add(arrival_s, sent_s, number);
      assembler_.push(node, sent_s - before_measured_s, sink);
    });
  }
}

void ScanDecoder::reset() {
  framer_.reset();
  stamps_.reset();
  assembler_.reset();
  jitter_.restart();
}

}  // namespace stereo_nav::laser
