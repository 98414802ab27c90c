#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "sensors/camera/frame.h"

namespace stereo_nav::camera {

/// Two frames that belong together; they may differ in time.
struct FramePair {
  Frame left;
  Frame right;
  std::int64_t timeOffset_ns() const { return right.time_ns - left.time_ns; }
};

/// Counts of the frames. Every frame pushed is paired, dropped for one of the reasons, or still waiting.
struct PairerCounts {
  std::uint64_t pairs = 0;
  std::array<std::uint64_t, 2> without_partner{};  ///< no frame of the other camera within max_time_offset
  std::array<std::uint64_t, 2> out_of_order{};     ///< not later than the camera's previous frame
};

/// The time between a camera's frames, as the median of the latest intervals. A gap in the driver's counter
/// counts as an interval of several frames. A gap that the counter does not show does not disturb the median.
class FramePeriod {
 public:
  explicit FramePeriod(std::int64_t nominal_ns) : nominal_ns_(nominal_ns) {}
  void add(std::int64_t interval_ns, std::uint32_t frames);
  std::int64_t median_ns() const;

 private:
  std::int64_t nominal_ns_;
  std::deque<std::int64_t> latest_;
};

/// Pairs the frames of two free-running cameras: nearest in time, each frame once, in order, never more than
/// `max_time_offset` apart.
///
/// With frames a period T apart, no later frame can be nearer than one at most T/2 away: such a pair is
/// released at once, when its later image arrives. Between T/2 and max_time_offset the decision waits for the
/// next frame of the earlier camera, at most until the later camera's next frame has come.
class LeftRightPairer {
 public:
  LeftRightPairer(std::int64_t nominal_period_ns, std::int64_t max_time_offset_ns);

  /// Takes a frame of one camera and returns the pair that it completes, if any. Frames of one camera must
  /// come in order of time; a frame that does not is dropped and counted.
  std::optional<FramePair> push(Side side, Frame frame);

  /// Forgets the waiting frames (they count as without partner) and the time of the latest one, e.g. after a
  /// reconnection.
  void restart(Side side);

  void setMaxTimeOffset(std::int64_t max_time_offset_ns) { max_time_offset_ns_ = max_time_offset_ns; }
  std::int64_t maxTimeOffset_ns() const { return max_time_offset_ns_; }
  /// The measured time between the left camera's frames; the nominal one at first.
  std::int64_t period_ns() const { return lane(Side::kLeft).period.median_ns(); }
  const PairerCounts& counts() const { return counts_; }
  std::size_t waiting(Side side) const { return lane(side).frames.size(); }

 private:
  struct Lane {
    explicit Lane(std::int64_t nominal_ns) : period(nominal_ns) {}
    std::deque<Frame> frames;
    FramePeriod period;
    std::optional<std::int64_t> latest_ns;
    std::uint32_t latest_sequence = 0;
  };
  enum class Verdict { kPair, kDropEarlier, kWait };

  const Lane& lane(Side side) const { return lanes_[static_cast<std::size_t>(side)]; }
  Lane& lane(Side side) { return lanes_[static_cast<std::size_t>(side)]; }
  Verdict judge(const Lane& earlier, const Lane& later) const;
  void dropOldest(Side side);
  FramePair takePair();

  std::int64_t max_time_offset_ns_;
  std::array<Lane, 2> lanes_;
  PairerCounts counts_;
};

}  // namespace stereo_nav::camera
