#pragma once

#include <optional>
#include <string>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

/// One line when the ground truth seems to give the poses of another frame than base_link: its positions fit
/// the estimate, its axes do not, and one constant rotation between the axes explains most of that: a path
/// that was lost for a while has no such rotation. Names the left camera where its frame explains it.
std::optional<std::string> wrongTruthFrame(const EvaluationInput& input, const EvaluationSummary& summary);

}  // namespace stereo_nav::eval
