#pragma once

#include <optional>
#include <string>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

/// One line when the ground truth seems to give the poses of another frame than base_link: its positions fit
/// the estimate, its axes do not. Names the left camera where its frame explains the ground truth.
std::optional<std::string> wrongTruthFrame(const EvaluationInput& input, const EvaluationSummary& summary);

}  // namespace stereo_nav::eval
