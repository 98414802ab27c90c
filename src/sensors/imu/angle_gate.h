#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "sensors/imu/angle_protocol.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::imu {

struct AngleGateParams {
  double noise_deg = 0.1;
  double max_acceleration_deg_s2 = 1500.0;
  double max_rate_deg_s = 500.0;

  void describe(ParameterVisitor& visitor);
};

/// A candidate that the gate has accepted.
struct AngleFrame {
  ModuleAngles angles;
  std::uint64_t index =
      0;  ///< number of frames that the module has sent since the first one, lost ones included
  std::uint64_t last_byte = 0;  ///< position in the stream of the frame's last byte
  double arrival_s = 0.0;       ///< when that byte arrived
};

/// Since the start of the stream.
struct AngleGateCounters {
  std::uint64_t delivered = 0;
  std::uint64_t implausible = 0;  ///< candidates refused because they fit neither their past nor their future
};

/// Decides which candidates are frames. There is no checksum, so that a corrupt byte shows only as an
/// attitude that a body cannot have reached. With T the module's own period and a the largest angular
/// acceleration:
///
/// 1. A candidate within `noise + a T^2` of the attitude that the constant rate of the last two frames
///    predicts is delivered at once, whatever comes later (second difference of a motion of bounded
///    acceleration).
/// 2. Any other candidate waits. It is delivered when the next one confirms it: it must lie within `noise + a
///    n1 n2 T^2 / 2` of the line between its neighbours (n1, n2: periods to them), and not farther from the
///    expected path than a few times the first bound.
/// 3. Five waiting candidates on one line, with a possible rate, start a new path: at the start, after a gap,
///    or after the module set its yaw to something else.
///
/// Every delivered frame has a header at exactly 15 bytes before or after its own. Frames are delivered in
/// order. A yaw that passes +-180 or 0/360 degrees is an ordinary step.
class AngleGate {
 public:
  using Sink = std::function<void(const AngleFrame&)>;

  explicit AngleGate(const AngleGateParams& params) : params_(params) {}

  /// `arrival_s`: when the candidate's last byte arrived, seconds on any steady clock.
  void push(const AngleCandidate& candidate, double arrival_s, const Sink& sink);
  void reset();
  const AngleGateCounters& counters() const { return counters_; }
  /// The module's period as measured, seconds; 0.01 until there is a measurement.
  double period_s() const { return period_s_; }

 private:
  struct Item {
    AngleFrame frame;
    bool chained = false;  ///< a header stands 15 bytes before or after this one's
  };
  static constexpr std::size_t kMaxWaiting = 8;
  static constexpr std::size_t kPathFrames = 5;  ///< number of frames that begin a path
  using Path = std::array<Item, kPathFrames>;

  Item itemOf(const AngleCandidate& candidate, double arrival_s);
  void measurePeriod(const Item& item);
  bool onTrack(const Item& item, double tolerance_factor) const;
  bool onLine(const Item& first, const Item& middle, const Item& last) const;
  bool possibleRate(const Item& first, const Item& last) const;
  bool confirmOne(const Item& newest, const Sink& sink);
  bool startTrack(const Sink& sink);
  bool completePath(Path& path, std::size_t missing, std::size_t available) const;
  void deliver(const Item& item, const Sink& sink);
  void forgetWaiting(std::size_t count);
  void removeFront(std::size_t count);

  AngleGateParams params_;
  double period_s_ = 0.01;
  std::optional<Item> period_start_;
  bool period_settled_ = false;
  std::optional<Item> newest_;  ///< the newest candidate, accepted or not; it continues the frame index

  // The path: the last two delivered frames that belong together; either both or none.
  std::optional<Item> before_last_, last_;
  std::array<Item, kMaxWaiting> waiting_;
  std::size_t waiting_count_ = 0;
  AngleGateCounters counters_;
};

}  // namespace stereo_nav::imu
