#pragma once

#include <string>

namespace stereo_nav::tools {

/// Runs all scenarios of a file of the public grid benchmark on the map of its name beside it, and prints how
/// many were solved, how many with the optimal length, and what a search costs. Returns whether all were.
/// Throws InputError.
bool runScenarios(const std::string& scenario_file);

}  // namespace stereo_nav::tools
