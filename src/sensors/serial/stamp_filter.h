#pragma once

#include <optional>

#include "sensors/serial/lower_hull.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::serial {

struct StampFilterParams {
  double window_s = 20.0;
  double settle_s = 2.0;

  void describe(ParameterVisitor& visitor);
};

/// Estimates when a module sent its frames from when they arrived.
///
/// Model: frame number x left the module at p x + t0, with the module's own, nearly constant period p. It
/// arrived d later, where d >= 0 varies: a USB adapter collects bytes and hands them over every 1 to 16 ms,
/// the kernel and this program add their own waits. No frame arrives before it was sent, so the line p x + t0
/// is the highest one below all arrivals: the edge of their lower convex hull over the middle of the window
/// (Moon, Skelly, Towsley: Estimation and removal of clock skew from network delay measurements, INFOCOM
/// 1999). A stamp is that line at x: never later than the arrival, and free of d except for its smallest
/// value.
///
/// The window moves on in two overlapping generations of `window_s` each, of which the older one gives the
/// line. Its slope is replaced only by one from as long a span, or from half a window: at the very start
/// after `settle_s`, before that it is the mean rate so far, and stamps are accurate only to the batching
/// divided by the time passed. Frames that are lost unnoticed would shift all later ones: when the arrivals
/// of half a second are all late by more than half a period, the window starts again with the slope that it
/// had.
class StampFilter {
 public:
  explicit StampFilter(const StampFilterParams& params) : params_(params) {}

  /// `x`: device clock, growing; either the frame's number or the module's own time in seconds.
  /// `step`: what a lost frame adds to x. `arrival_s`: seconds on a steady clock.
  /// Returns the sending time in seconds on that steady clock, larger than the one before.
  double stamp(double x, double step, double arrival_s);
  /// Tells that the device clock stood still for an unknown time before the next frame: only its rate remains
  /// known.
  void restartClock();
  void reset();

  /// Seconds per unit of x; absent before the second frame.
  std::optional<double> slope() const { return slope_; }

 private:
  void updateSlope(double x, double arrival_s);
  void beginWindow();
  void addToWindow(double x, double arrival_s);
  void watchForStep(double late_s, double threshold_s, double arrival_s);

  StampFilterParams params_;
  std::optional<double> slope_;
  LowerHull older_, younger_;
  double window_start_s_ = 0.0;
  double younger_start_s_ = 0.0;
  std::optional<double> last_x_, last_stamp_s_;
  double first_x_ = 0.0, first_arrival_s_ = 0.0;
  double slope_span_s_ = 0.0;  ///< time over which the slope was measured; 0 before the first settled window
  std::optional<double> late_since_s_;
  double last_arrival_s_ = 0.0;
};

}  // namespace stereo_nav::serial
