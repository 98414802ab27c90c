#include "sensors/imu/angle_gate.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::imu {
namespace {

/// A path is continued over at most this many periods.
constexpr double kMaxBridge = 4.0;
/// Neighbours that confirm each other are at most this many periods apart.
constexpr double kMaxSpacing = 2.0;
/// Silence after which nothing is known about the path any more.
constexpr double kMaxSilence_s = 0.5;
/// How far a candidate that the next one confirms may be from the expected path, in units of the tight bound.
constexpr double kConfirmedTolerance = 3.0;
/// Numbers of frames over which the period is measured: at first soon, then less often and more exactly.
constexpr std::uint64_t kFirstPeriodFrames = 5;
constexpr std::uint64_t kPeriodFrames = 100;

double steps(const AngleFrame& from, const AngleFrame& to) {
  return static_cast<double>(to.index) - static_cast<double>(from.index);
}

/// Change of the three angles by the shorter way, degrees.
Eigen::Vector3d change(const AngleFrame& from, const AngleFrame& to) {
  return (to.angles.vector() - from.angles.vector()).unaryExpr(&wrapDegrees);
}

double largest(const Eigen::Vector3d& angles_deg) {
  return angles_deg.unaryExpr(&wrapDegrees).lpNorm<Eigen::Infinity>();
}

}  // namespace

void AngleGateParams::describe(ParameterVisitor& visitor) {
  visitor.real("noise_deg", noise_deg, {0.001, 5.0}, "deg",
               "largest noise of the module's angles; frames that deviate by more are refused");
  visitor.real("max_acceleration_deg_s2", max_acceleration_deg_s2, {10.0, 1e5}, "deg/s^2",
               "largest angular acceleration of the robot; frames that would need more are refused");
  visitor.real("max_rate_deg_s", max_rate_deg_s, {10.0, 2000.0}, "deg/s",
               "largest turning rate of the robot; frames that would need more are refused");
}

void AngleGate::reset() {
  forgetWaiting(waiting_count_);
  before_last_.reset();
  last_.reset();
  newest_.reset();
  period_start_.reset();
  period_settled_ = false;
}

void AngleGate::push(const AngleCandidate& candidate, double arrival_s, const Sink& sink) {
  const bool after_silence = newest_ && arrival_s - newest_->frame.arrival_s > kMaxSilence_s;
  const Item item = itemOf(candidate, arrival_s);
  if (after_silence) {
    forgetWaiting(waiting_count_);
    last_.reset();
    period_start_.reset();
  }
  measurePeriod(item);
  newest_ = item;

  if (waiting_count_ == kMaxWaiting) forgetWaiting(1);
  waiting_[waiting_count_++] = item;
  while (confirmOne(item, sink)) {
  }
  if (item.chained && onTrack(item, 1.0)) {
    forgetWaiting(waiting_count_ - 1);
    waiting_count_ = 0;
    deliver(item, sink);
  } else if (!startTrack(sink) && last_ && steps(last_->frame, item.frame) > kMaxBridge) {
    last_.reset();
  }
}

/// Derives the frame index from the position in the stream, so that lost frames count, too.
AngleGate::Item AngleGate::itemOf(const AngleCandidate& candidate, double arrival_s) {
  Item item;
  item.frame.angles = candidate.angles;
  item.frame.last_byte = candidate.first_byte + AngleFramer::kFrameBytes - 1;
  item.frame.arrival_s = arrival_s;
  item.chained = candidate.follows;
  if (newest_) {
    const std::uint64_t bytes = item.frame.last_byte - newest_->frame.last_byte;
    const std::uint64_t frames = (bytes + AngleFramer::kFrameBytes / 2) / AngleFramer::kFrameBytes;
    item.frame.index = newest_->frame.index + std::max<std::uint64_t>(frames, 1);
  }
  if (candidate.follows && waiting_count_ > 0) waiting_[waiting_count_ - 1].chained = true;
  return item;
}

void AngleGate::measurePeriod(const Item& item) {
  if (!period_start_) period_start_ = item;
  const auto count = item.frame.index - period_start_->frame.index;
  if (count < (period_settled_ ? kPeriodFrames : kFirstPeriodFrames)) return;
  const double duration_s = item.frame.arrival_s - period_start_->frame.arrival_s;
  period_s_ = std::clamp(duration_s / static_cast<double>(count), 1e-4, 1.0);
  if (count < kPeriodFrames) return;
  period_settled_ = true;
  period_start_ = item;
}

bool AngleGate::onTrack(const Item& item, double tolerance_factor) const {
  if (!last_) return false;
  const double count = steps(last_->frame, item.frame);
  if (count > kMaxBridge) return false;
  const Eigen::Vector3d step =
      change(before_last_->frame, last_->frame) / steps(before_last_->frame, last_->frame);
  const double tolerance = params_.noise_deg + params_.max_acceleration_deg_s2 * period_s_ * period_s_;
  return largest(change(last_->frame, item.frame) - count * step) <= tolerance_factor * tolerance;
}

bool AngleGate::onLine(const Item& first, const Item& middle, const Item& last) const {
  const double before = steps(first.frame, middle.frame);
  const double after = steps(middle.frame, last.frame);
  if (std::max(before, after) > kMaxSpacing) return false;
  const Eigen::Vector3d expected = change(first.frame, last.frame) * (before / (before + after));
  const double tolerance =
      params_.noise_deg + 0.5 * params_.max_acceleration_deg_s2 * before * after * period_s_ * period_s_;
  return largest(change(first.frame, middle.frame) - expected) <= tolerance;
}

bool AngleGate::possibleRate(const Item& first, const Item& last) const {
  const double duration_s = steps(first.frame, last.frame) * period_s_;
  return change(first.frame, last.frame).lpNorm<Eigen::Infinity>() <=
         params_.max_rate_deg_s * duration_s + params_.noise_deg;
}

/// Delivers the first waiting candidate that lies between the end of the path and `newest`, if there is one;
/// the candidates before it are refused.
bool AngleGate::confirmOne(const Item& newest, const Sink& sink) {
  if (!last_) return false;
  for (std::size_t i = 0; i + 1 < waiting_count_; ++i) {
    const Item item = waiting_[i];
    if (!item.chained || !onTrack(item, kConfirmedTolerance) || !possibleRate(*last_, item) ||
        !onLine(*last_, item, newest)) {
      continue;
    }
    forgetWaiting(i);
    removeFront(1);
    deliver(item, sink);
    return true;
  }
  return false;
}

/// Begins a new path when the newest waiting candidate completes one. Fewer candidates would not suffice:
/// three frames with the same byte damaged may lie on a line that a true frame happens to cross.
bool AngleGate::startTrack(const Sink& sink) {
  if (waiting_count_ < kPathFrames || !waiting_[waiting_count_ - 1].chained) return false;
  Path path;
  path.back() = waiting_[waiting_count_ - 1];
  if (!completePath(path, path.size() - 1, waiting_count_ - 1)) return false;
  counters_.implausible += waiting_count_ - path.size();
  waiting_count_ = 0;
  last_.reset();
  for (const Item& item : path) deliver(item, sink);
  return true;
}

/// Fills the first `missing` items of a path from the first `available` waiting candidates.
bool AngleGate::completePath(Path& path, std::size_t missing, std::size_t available) const {
  if (missing == 0) return possibleRate(path.front(), path.back());
  for (std::size_t i = available; i-- > 0;) {
    if (!waiting_[i].chained) continue;
    path[missing - 1] = waiting_[i];
    const bool straight =
        missing + 1 >= path.size() || onLine(path[missing - 1], path[missing], path[missing + 1]);
    if (straight && completePath(path, missing - 1, i)) return true;
  }
  return false;
}

void AngleGate::deliver(const Item& item, const Sink& sink) {
  before_last_ = last_ ? last_ : item;
  last_ = item;
  ++counters_.delivered;
  sink(item.frame);
}

void AngleGate::forgetWaiting(std::size_t count) {
  removeFront(count);
  counters_.implausible += count;
}

void AngleGate::removeFront(std::size_t count) {
  std::move(waiting_.begin() + static_cast<std::ptrdiff_t>(count),
            waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_), waiting_.begin());
  waiting_count_ -= count;
}

}  // namespace stereo_nav::imu
