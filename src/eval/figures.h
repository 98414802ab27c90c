#pragma once

#include <string>
#include <vector>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {

/// A picture of the report as a gnuplot script.
struct Figure {
  std::string name;  ///< of its file, without extension
  std::string caption;
  std::string script;
};

/// The pictures for which the run has data.
std::vector<Figure> makeFigures(const Evaluation& evaluation, const std::vector<FrameRecord>& records);

}  // namespace stereo_nav::eval
