#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

/// Frames without a pose that follow one another.
struct Loss {
  std::size_t first = 0;  ///< number of the frame, counted from 0, as the lines of frames.csv
  std::size_t last = 0;   ///< likewise; equal to `first` where one frame alone is lost
  double from_s = 0.0;    ///< since the first frame
  double to_s = 0.0;      ///< likewise
  std::string reason;     ///< of its first frame; "no reason given" where it has none
};

/// All losses of a run, in order of time.
std::vector<Loss> lossesOf(const std::vector<FrameErrors>& frames);

/// "frames 12 to 17 (1.20 to 1.70 s)"
std::string framesText(const Loss& loss);

/// The frames and the reason: "frames 12 to 17 (1.20 to 1.70 s): REASON"
std::string toText(const Loss& loss);

}  // namespace stereo_nav::eval
