#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::tools {

struct SimulateOptions {
  std::string scenario;     ///< path of the file
  std::string calibration;  ///< folder with left.yaml and right.yaml
  std::string output;       ///< bag
  std::string rig;          ///< rig file with the wheels; empty: there are none
  std::string true_rig;     ///< rig file to write, with the wheels as they truly are; may be empty
  std::string commands;     ///< file of velocities that drive the robot; empty: the scenario's path
  std::vector<std::string> overrides;  ///< section.name=value
  std::uint64_t seed = 1;
  double duration_s = std::numeric_limits<double>::infinity();
  int threads = 1;
  bool images = true;
  bool compress = false;
};

/// Nothing when only help was asked for. Throws InputError.
std::optional<SimulateOptions> parseSimulateOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
