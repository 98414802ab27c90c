#pragma once

#include <optional>
#include <string>

#include "stereo_nav/eval/evaluation.h"
#include "stereo_nav/eval/timing.h"

namespace stereo_nav::eval {

/// Writes `report.html` (one file that includes the pictures) and the same pictures as `*.svg` files into
/// `directory`, which must exist. Returns a one-line warning when pictures are missing from the report, e.g.
/// because gnuplot is not installed; the numbers are written in any case. Throws InputError when the
/// directory cannot be written.
///
/// Pictures are drawn by the program `gnuplot` (package gnuplot-nox) to SVG: it needs no display and no
/// graphics library to link, has the same language since long before Ubuntu 20.04, draws in milliseconds what
/// a Python route needs seconds for, and its text and lines stay sharp in the page.
std::optional<std::string> writeReport(const std::string& directory, const Evaluation& evaluation,
                                       const EvaluationInput& input, const TimingSummary& timing);

}  // namespace stereo_nav::eval
