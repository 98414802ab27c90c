#include "sensors/camera/pairer.h"

#include <cstdlib>
#include <utility>
#include <vector>

#include "core/statistics.h"

namespace stereo_nav::camera {
namespace {

constexpr std::size_t kMostIntervals = 15;
/// Frames; a counter that jumps further, or does not move, does not count frames.
constexpr std::uint32_t kLongestGap = 1000;
/// Frames of one camera that wait for the other one. When the other one stalls, the oldest goes.
constexpr std::size_t kMostWaiting = 4;

}  // namespace

void FramePeriod::add(std::int64_t interval_ns, std::uint32_t frames) {
  const bool counter_runs = frames >= 1 && frames < kLongestGap;
  latest_.push_back(counter_runs ? interval_ns / frames : interval_ns);
  if (latest_.size() > kMostIntervals) latest_.pop_front();
}

std::int64_t FramePeriod::get_ns() const {
  constexpr std::size_t kEnough = 3;
  if (latest_.size() < kEnough) return nominal_ns_;
  std::vector<std::int64_t> intervals(latest_.begin(), latest_.end());
  return upperMedian(intervals);
}

Pairer::Pairer(std::int64_t nominal_period_ns, std::int64_t max_skew_ns)
    : max_skew_ns_(max_skew_ns), lanes_{Lane(nominal_period_ns), Lane(nominal_period_ns)} {}

std::optional<FramePair> Pairer::push(Side side, Frame frame) {
  Lane& own = lane(side);
  if (own.latest_ns) {
    if (frame.time_ns <= *own.latest_ns) {
      ++counts_.out_of_order[static_cast<std::size_t>(side)];
      return std::nullopt;
    }
    own.period.add(frame.time_ns - *own.latest_ns, frame.sequence - own.latest_sequence);
  }
  own.latest_ns = frame.time_ns;
  own.latest_sequence = frame.sequence;
  own.frames.push_back(std::move(frame));

  // A frame can complete one pair only: every pair needs a new frame of each side, and before this call none
  // was possible.
  while (!lane(Side::Left).frames.empty() && !lane(Side::Right).frames.empty()) {
    const bool left_first =
        lane(Side::Left).frames.front().time_ns <= lane(Side::Right).frames.front().time_ns;
    const Side earlier = left_first ? Side::Left : Side::Right;
    const Verdict verdict = judge(lane(earlier), lane(otherSide(earlier)));
    if (verdict == Verdict::Pair) return takePair();
    if (verdict == Verdict::Wait) break;
    dropOldest(earlier);
  }
  if (own.frames.size() > kMostWaiting) dropOldest(side);
  return std::nullopt;
}

Pairer::Verdict Pairer::judge(const Lane& earlier, const Lane& later) const {
  const std::int64_t early = earlier.frames.front().time_ns;
  const std::int64_t late = later.frames.front().time_ns;
  const std::int64_t skew = late - early;
  if (skew > max_skew_ns_) return Verdict::DropEarlier;  // all others of that camera come later still
  if (earlier.frames.size() > 1) {
    const std::int64_t next = earlier.frames[1].time_ns;
    return std::abs(next - late) < skew ? Verdict::DropEarlier : Verdict::Pair;
  }
  const bool next_cannot_be_nearer = 2 * skew <= earlier.period.get_ns();
  const bool next_is_overdue = later.frames.size() > 1;
  return next_cannot_be_nearer || next_is_overdue ? Verdict::Pair : Verdict::Wait;
}

void Pairer::restart(Side side) {
  Lane& own = lane(side);
  while (!own.frames.empty()) dropOldest(side);
  own.latest_ns.reset();
}

void Pairer::dropOldest(Side side) {
  lane(side).frames.pop_front();
  ++counts_.without_partner[static_cast<std::size_t>(side)];
}

FramePair Pairer::takePair() {
  FramePair pair{std::move(lane(Side::Left).frames.front()), std::move(lane(Side::Right).frames.front())};
  lane(Side::Left).frames.pop_front();
  lane(Side::Right).frames.pop_front();
  ++counts_.pairs;
  return pair;
}

}  // namespace stereo_nav::camera
