#pragma once

#include <random>
#include <vector>

#include "mapping/mono/mono_params.h"
#include "mapping/mono/mono_update.h"

namespace stereo_nav::mapping {

/// Indices of the matches that one hypothesis explains best. Each hypothesis is the state corrected by a
/// single match; since the prediction knows the rest, one is enough (Civera et al. 2010, algorithm 1). The
/// number of hypotheses follows from the share of agreeing matches, and has a budget.
std::vector<std::size_t> lowInnovationInliers(const MonoState& state, const ImageModel& model,
                                              const std::vector<PixelMatch>& matches,
                                              const OnePointRansacParams& params, std::mt19937& random);

/// Of matches that were looked for anew in the smaller ellipses of a corrected state, those that it explains
/// within its own uncertainty: near landmarks, whose innovation was large since their depth was not known.
std::vector<PixelMatch> highInnovationInliers(const MonoState& corrected, const ImageModel& model,
                                              const std::vector<PixelMatch>& matches,
                                              const OnePointRansacParams& params);

}  // namespace stereo_nav::mapping
