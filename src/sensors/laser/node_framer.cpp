#include "sensors/laser/node_framer.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::laser {
namespace {

using rplidar::kNodeBytes;

constexpr double kTolerance_deg = 8.0;
/// A turning begins where headings are even, i.e. not at an edge.
constexpr double kBeginTolerance_deg = 2.0;
/// 8000 samples in a revolution of half a second, and 1000 in one of a tenth, with much to spare.
constexpr double kMinStep_deg = 0.03;
constexpr double kMaxStep_deg = 6.0;
/// Gains of the alpha-beta filter that follows the turning, about critically damped; errors are limited, so
/// that an edge does not change the speed.
constexpr double kPositionGain = 0.1;
constexpr double kSpeedGain = 0.0025;
constexpr double kMaxError_deg = 1.0;

/// Within [-180, 180].
double wrapped(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

}  // namespace

void NodeFramer::reset() {
  size_ = skipped_ = 0;
  aligned_ = turning_known_ = false;
  step_deg_ = 0.0;
}

void NodeFramer::push(std::uint8_t byte, const Sink& sink) {
  buffer_[size_++] = byte;
  ++counters_.bytes;
  if (aligned_) {
    if (size_ < kNodeBytes) return;
    const std::optional<ScanNode> node = rplidar::decodeNode(buffer_.data());
    if (node && expected(*node, 1.0)) {
      size_ = 0;
      return deliver(*node, 0, 0, sink);
    }
    ++counters_.bad_nodes;
    aligned_ = false;
  }
  while (!aligned_ && size_ >= (turning_known_ ? kKnownRun : kUnknownRun) * kNodeBytes) {
    if (turning_known_ ? continues() : begins()) {
      deliverRun(turning_known_ ? kKnownRun : kUnknownRun, sink);
    } else {
      dropByte();
    }
  }
}

/// `nodes_ahead`: how many nodes the device has sent since the last delivered one, this one included.
bool NodeFramer::expected(const ScanNode& node, double nodes_ahead) const {
  return std::abs(wrapped(node.heading_deg - turned_deg_ - nodes_ahead * step_deg_)) <= kTolerance_deg;
}

/// Fills `run_` with the nodes at the front of the buffer.
bool NodeFramer::decodeRun(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = rplidar::decodeNode(&buffer_[i * kNodeBytes]);
    if (!node) return false;
    run_[i] = *node;
  }
  return true;
}

bool NodeFramer::continues() {
  if (!decodeRun(kKnownRun)) return false;
  const double skipped_nodes = std::ceil(static_cast<double>(skipped_) / kNodeBytes);
  for (std::size_t i = 0; i < kKnownRun; ++i) {
    if (!expected(run_[i], skipped_nodes + static_cast<double>(i + 1))) return false;
  }
  return true;
}

/// On success the turning is that of the run, up to before its first node.
bool NodeFramer::begins() {
  if (!decodeRun(kUnknownRun)) return false;
  const double step = wrapped(run_.back().heading_deg - run_.front().heading_deg) / (kUnknownRun - 1);
  if (step < kMinStep_deg || step > kMaxStep_deg) return false;
  int starts = 0;
  for (std::size_t i = 0; i < kUnknownRun; ++i) {
    starts += static_cast<int>(run_[i].start);
    const double even = run_.front().heading_deg + step * static_cast<double>(i);
    if (std::abs(wrapped(run_[i].heading_deg - even)) > kBeginTolerance_deg) return false;
  }
  if (starts > 1) return false;
  if (step_deg_ > 0.0) {
    const double gap_deg = wrapped(run_.front().heading_deg - turned_deg_ - 180.0) + 180.0;
    counters_.dropped += static_cast<std::uint64_t>(std::max(0L, std::lround(gap_deg / step) - 1));
  }
  step_deg_ = step;
  turned_deg_ = run_.front().heading_deg - step;
  restarted_ = true;
  return true;
}

/// How many nodes were lost before a run that continues the turning, by its headings: bytes may have been
/// lost in whole nodes, or foreign ones may have come in between.
std::size_t NodeFramer::lostBeforeRun() const {
  const double skipped_nodes = static_cast<double>(skipped_) / kNodeBytes;
  double lost = skipped_nodes;
  for (std::size_t i = 0; i < kKnownRun; ++i) {
    const double ahead_deg = step_deg_ * (skipped_nodes + static_cast<double>(i + 1));
    lost += wrapped(run_[i].heading_deg - turned_deg_ - ahead_deg) / step_deg_ / kKnownRun;
  }
  return static_cast<std::size_t>(std::max(0L, std::lround(lost)));
}

/// The run is all that the buffer holds.
void NodeFramer::deliverRun(std::size_t count, const Sink& sink) {
  const std::size_t lost = turning_known_ ? lostBeforeRun() : 0;
  turning_known_ = aligned_ = true;
  size_ = skipped_ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    deliver(run_[i], i == 0 ? lost : 0, (count - 1 - i) * kNodeBytes, sink);
  }
}

void NodeFramer::deliver(const ScanNode& node, std::size_t missing, std::size_t bytes_behind,
                         const Sink& sink) {
  const auto ahead = static_cast<double>(missing + 1);
  const double expected_deg = turned_deg_ + ahead * step_deg_;
  const double error_deg = wrapped(node.heading_deg - expected_deg);
  const double limited = std::clamp(error_deg, -kMaxError_deg, kMaxError_deg);
  turned_deg_ = expected_deg + kPositionGain * limited;
  step_deg_ = std::clamp(step_deg_ + kSpeedGain * limited, kMinStep_deg, kMaxStep_deg);
  index_ += missing + 1;
  counters_.dropped += missing;
  ++counters_.nodes;
  FramedNode framed;
  framed.node = node;
  framed.index = index_;
  framed.last_byte = counters_.bytes - 1 - bytes_behind;
  framed.turned_deg = expected_deg + error_deg;
  framed.expected_turned_deg = expected_deg;
  framed.restarted = restarted_;
  restarted_ = false;
  sink(framed);
}

void NodeFramer::dropByte() {
  std::copy(buffer_.begin() + 1, buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
  --size_;
  ++skipped_;
  ++counters_.bytes_skipped;
  if (skipped_ > kForget) turning_known_ = false;
}

}  // namespace stereo_nav::laser
