#pragma once

#include <cstdint>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// The times at which the two cameras take their images. The left camera's clock is the reference.
struct TimingParams {
  double rate_hz = 30.0;
  double time_offset_ms = 0.0;
  double jitter_ms = 0.0;
  bool free_running = false;
  double clock_ppm = 200.0;

  void describe(ParameterVisitor& visitor);
};

/// A stereo pair's instants: the middles of the two exposures.
struct PairInstants {
  double left_s;
  double right_s;
  std::uint32_t left_sequence;  ///< counts every image of the camera, paired or not
  std::uint32_t right_sequence;
  std::uint64_t pairs_dropped;  ///< left images that have found no partner so far
};

/// All pairs of a recording that starts at 0. Each camera runs on its own; then every left image is paired
/// with the right image nearest in time, if no other left image is nearer to that one and it is at most half
/// a period away. The capture node does the same with real cameras. Deterministic in `seed`.
std::vector<PairInstants> pairInstants(const TimingParams& timing, double duration_s, std::uint64_t seed);

}  // namespace stereo_nav::sim
