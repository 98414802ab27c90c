#include "sensors/serial/link_monitor.h"

#include <cmath>

namespace stereo_nav::serial {
namespace {

/// One step of Welford's running mean and sum of squared deviations.
void accumulate(double value, std::uint64_t count, double& mean, double& m2) {
  const double delta = value - mean;
  mean += delta / static_cast<double>(count);
  m2 += delta * (value - mean);
}

double standardDeviation(double m2, std::uint64_t count) {
  return count > 1 ? std::sqrt(m2 / static_cast<double>(count - 1)) : 0.0;
}

}  // namespace

void JitterMeter::add(double arrival_s, double stamp_s, double device_clock) {
  if (count_ > 0 && device_clock <= last_clock_) restart();
  ++count_;
  accumulate(arrival_s - stamp_s, count_, delay_mean_, delay_m2_);
  if (count_ == 1) {
    first_stamp_s_ = stamp_s;
    first_clock_ = device_clock;
  } else {
    const double slope = (stamp_s - first_stamp_s_) / (device_clock - first_clock_);
    const double deviation_s = stamp_s - last_stamp_s_ - slope * (device_clock - last_clock_);
    accumulate(deviation_s, count_ - 1, deviation_mean_, deviation_m2_);
  }
  last_stamp_s_ = stamp_s;
  last_clock_ = device_clock;
}

double JitterMeter::rate_hz() const {
  return duration_s() > 0.0 ? static_cast<double>(count_ - 1) / duration_s() : 0.0;
}

double JitterMeter::arrivalJitter_s() const {
  return standardDeviation(delay_m2_, count_);
}

double JitterMeter::stampJitter_s() const {
  return count_ > 1 ? standardDeviation(deviation_m2_, count_ - 1) : 0.0;
}

void LinkMonitor::opened(double now_s) {
  if (open_) return;
  open_ = true;
  any_frame_ = false;
  opened_s_ = last_bytes_s_ = last_frame_s_ = now_s;
}

void LinkMonitor::received(std::uint64_t bytes, double now_s) {
  if (bytes > 0) last_bytes_s_ = now_s;
}

void LinkMonitor::delivered(double now_s) {
  any_frame_ = true;
  last_frame_s_ = now_s;
}

double LinkMonitor::silentFor_s(double now_s) const {
  return open_ ? now_s - last_bytes_s_ : 0.0;
}

LinkState LinkMonitor::state(double now_s) const {
  if (!open_) return LinkState::kDisconnected;
  if (now_s - last_bytes_s_ > kPatience_s) return LinkState::kSilent;
  if (now_s - last_frame_s_ > kPatience_s) return LinkState::kNoFrames;
  return any_frame_ ? LinkState::kStreaming : LinkState::kWaiting;
}

}  // namespace stereo_nav::serial
