#pragma once

#include "mapping/loop/loop_candidate.h"
#include "mapping/loop/loop_params.h"

namespace stereo_nav::mapping {

/// Whether the query really is where the candidate says, by geometry alone: mutual matches of the
/// descriptors, a pose by RANSAC, the landmarks of the neighbours, refinement. Writes figures and pose into
/// the candidate. Returns whether it passed; otherwise the candidate's stage is the one that rejected it.
bool verifyLoop(const VerificationParams& params, const vision::StereoCalibration& calibration,
                const KeyframeChain& chain, LoopCandidate& candidate);

}  // namespace stereo_nav::mapping
