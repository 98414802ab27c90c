#pragma once

#include <optional>
#include <string>

#include "core/point_alignment.h"

namespace stereo_nav::tools {

struct MapInfoOptions {
  std::string file;
  std::string tum, g2o, ply;  ///< what to write; empty: not
  bool in_world = false;      ///< trajectory and points in the world instead of the map
  std::string world_pairs, save;
  SimilarityFreedom freedom;
};

/// Nothing when help was asked for and printed. Throws InputError.
std::optional<MapInfoOptions> parseMapInfoOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
