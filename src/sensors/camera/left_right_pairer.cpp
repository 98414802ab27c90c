#include "sensors/camera/left_right_pairer.h"

#include <cstdlib>
#include <utility>
#include <vector>

#include "core/statistics.h"

namespace stereo_nav::camera {
namespace {

constexpr std::size_t kMostIntervals = 15;
/// Longest gap, in frames. A counter that jumps further, or does not move, does not count frames.
constexpr std::uint32_t kLongestGap = 1000;
/// Number of frames of one camera that may wait for the other one. When the other one stalls, the oldest
/// frame is dropped.
constexpr std::size_t kMostWaiting = 4;

}  // namespace

void FramePeriod::add(std::int64_t interval_ns, std::uint32_t frames) {
  const bool counter_runs = frames >= 1 && frames < kLongestGap;
  latest_.push_back(counter_runs ? interval_ns / frames : interval_ns);
  if (latest_.size() > kMostIntervals) latest_.pop_front();
}

std::int64_t FramePeriod::median_ns() const {
  constexpr std::size_t kEnough = 3;
  if (latest_.size() < kEnough) return nominal_ns_;
  std::vector<std::int64_t> intervals(latest_.begin(), latest_.end());
  return upperMedian(intervals);
}

LeftRightPairer::LeftRightPairer(std::int64_t nominal_period_ns, std::int64_t max_time_offset_ns)
    : max_time_offset_ns_(max_time_offset_ns), lanes_{Lane(nominal_period_ns), Lane(nominal_period_ns)} {}

std::optional<FramePair> LeftRightPairer::push(Side side, Frame frame) {
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
  while (!lane(Side::kLeft).frames.empty() && !lane(Side::kRight).frames.empty()) {
    const bool left_first =
        lane(Side::kLeft).frames.front().time_ns <= lane(Side::kRight).frames.front().time_ns;
    const Side earlier = left_first ? Side::kLeft : Side::kRight;
    const Verdict verdict = judge(lane(earlier), lane(otherSide(earlier)));
    if (verdict == Verdict::kPair) return takePair();
    if (verdict == Verdict::kWait) break;
    dropOldest(earlier);
  }
  if (own.frames.size() > kMostWaiting) dropOldest(side);
  return std::nullopt;
}

LeftRightPairer::Verdict LeftRightPairer::judge(const Lane& earlier, const Lane& later) const {
  const std::int64_t early = earlier.frames.front().time_ns;
  const std::int64_t late = later.frames.front().time_ns;
  const std::int64_t offset = late - early;
  if (offset > max_time_offset_ns_)
    return Verdict::kDropEarlier;  // all later frames of the other camera are even further away
  if (earlier.frames.size() > 1) {
    const std::int64_t next = earlier.frames[1].time_ns;
    return std::abs(next - late) < offset ? Verdict::kDropEarlier : Verdict::kPair;
  }
  const bool next_cannot_be_nearer = 2 * offset <= earlier.period.median_ns();
  const bool next_is_overdue = later.frames.size() > 1;
  return next_cannot_be_nearer || next_is_overdue ? Verdict::kPair : Verdict::kWait;
}

void LeftRightPairer::restart(Side side) {
  Lane& own = lane(side);
  while (!own.frames.empty()) dropOldest(side);
  own.latest_ns.reset();
}

void LeftRightPairer::dropOldest(Side side) {
  lane(side).frames.pop_front();
  ++counts_.without_partner[static_cast<std::size_t>(side)];
}

FramePair LeftRightPairer::takePair() {
  FramePair pair{std::move(lane(Side::kLeft).frames.front()), std::move(lane(Side::kRight).frames.front())};
  lane(Side::kLeft).frames.pop_front();
  lane(Side::kRight).frames.pop_front();
  ++counts_.pairs;
  return pair;
}

}  // namespace stereo_nav::camera
