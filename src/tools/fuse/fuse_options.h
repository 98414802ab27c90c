#pragma once

#include <optional>
#include <set>
#include <string>

namespace stereo_nav::tools {

struct FuseOptions {
  std::string bag;
  std::string config;                       ///< path of the filter's parameter file
  std::string laser_config;                 ///< path of the laser odometry's
  std::set<std::string> only;               ///< sensors that are used, e.g. odom0; empty: all
  std::optional<std::string> ground_truth;  ///< TUM file or topic
  std::optional<std::string> ground_truth_frame;
  std::string output;  ///< folder
};

/// Nothing when help was asked for and printed. Throws InputError with one line for bad arguments.
std::optional<FuseOptions> parseFuseOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
