#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "grid/grid_geometry.h"

namespace stereo_nav::navigation {

/// Reads a `.map` file of the public grid benchmark (Sturtevant 2012; movingai.com): `type octile`, height,
/// width, `map`, then rows of characters, of which `.`, `G` and `S` are free. Returns CV_8UC1, 1 where not
/// free, with the file's first row as row 0. Throws InputError.
cv::Mat_<std::uint8_t> readBenchmarkMap(const std::string& path);

/// One line of a `.scen` file.
struct BenchmarkScenario {
  std::string map;  ///< as the file names it
  grid::Cell start, goal;
  double optimal_length =
      0.0;  ///< with eight neighbours and no corner cut; 0 between different cells: there is no way

  bool solvable() const { return optimal_length > 0.0 || start == goal; }
};

/// Reads a `.scen` file, version 1. Throws InputError that names the line.
std::vector<BenchmarkScenario> readBenchmarkScenarios(const std::string& path);

}  // namespace stereo_nav::navigation
