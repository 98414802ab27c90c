#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mapping/map/robust_optimiser.h"

namespace stereo_nav::tools {

struct OptimiseOptions {
  std::string file, output;
  bool robust = false;
  double false_loops_percent = 0.0;
  std::uint64_t seed = 1;
  mapping::RobustParams params;
};

/// Nothing when help was asked for and printed. Throws InputError.
std::optional<OptimiseOptions> parseOptimiseOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
