#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace stereo_nav::eval {

/// How long one frame took, wall-clock milliseconds.
struct FrameTiming {
  double frame_ms = 0.0;  ///< the odometry alone: neither decoding, rectification nor the disparity map
  double disparity_ms = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no disparity map was computed
  std::vector<std::pair<std::string, double>> stages_ms;           ///< in the order in which they run
};

/// timing.json.
struct TimingSummary {
  double median_ms;  ///< of the time per frame
  double p95_ms;     ///< 95th percentile
  double p99_ms;     ///< 99th percentile
  double max_ms;     ///< of the slowest frame
  std::vector<std::pair<std::string, double>>
      stage_medians_ms;        ///< in the order in which the stages first appeared
  double disparity_median_ms;  ///< NaN: no disparity map was computed
};

/// Statistics over the frames of one run, or of several runs in succession. All values are NaN without
/// frames.
TimingSummary summariseTiming(const std::vector<FrameTiming>& frames);

/// Text of timing.json.
std::string toJson(const TimingSummary& timing);

}  // namespace stereo_nav::eval
