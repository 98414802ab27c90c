#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "sensors/laser/node_framer.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::laser {

struct ScanParams {
  int beams = 360;
  double range_min_m = 0.15;
  double range_max_m = 12.0;

  void describe(ParameterVisitor& visitor);
};

/// One revolution. Beam i points at -i * 360 / beams degrees about the z axis (upwards) of the scanner, whose
/// x axis is the device's own zero, and was measured at time_s + i * time_increment_s: the head turns
/// clockwise.
struct Scan {
  double time_s = 0.0;  ///< of the first beam, on the steady clock
  double time_increment_s = 0.0;
  double scan_time_s = 0.0;  ///< of the revolution
  /// Metres, by REP-117: -Inf nearer than range_min_m, +Inf farther than range_max_m, NaN where the device
  /// measured nothing or no node came.
  std::vector<float> ranges_m;
  std::vector<float> qualities;  ///< 0 to 63; 0 where there is no node
};

/// Makes scans of nodes. Each node goes to the beam that is nearest to its own heading, and where two compete
/// the nearer one wins: scans have evenly spaced beams at the same angles, although the nodes are not evenly
/// spaced. The times are those of the even turning that fits the nodes of the revolution best (least
/// squares).
class ScanAssembler {
 public:
  using Sink = std::function<void(const Scan&)>;

  explicit ScanAssembler(const ScanParams& params) : params_(params) {}

  /// `time_s`: when the node was measured, on the steady clock.
  void push(const FramedNode& node, double time_s, const Sink& sink);
  /// Forgets the revolution that has begun.
  void reset();

 private:
  struct TimedNode {
    double turned_deg;
    double time_s;
    float range_m;
    float quality;
  };

  float rangeOf(const ScanNode& node) const;
  void finish(const Sink& sink);
  void setTimes(std::size_t nodes, Scan& scan) const;

  ScanParams params_;
  std::vector<TimedNode> nodes_;  ///< of this revolution, and the first ones of the next
  bool begun_ = false;
  bool whole_ = false;           ///< the revolution was seen from its beginning
  double end_deg_ = 0.0;         ///< where the revolution ends, as turned_deg
  std::vector<double> offsets_;  ///< scratch: how far the node in each beam is from its middle
};

}  // namespace stereo_nav::laser
