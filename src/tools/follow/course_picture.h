#pragma once

#include <string>

#include "navigation/control/course_run.h"

namespace stereo_nav::tools {

/// An SVG: the course and the way of the reference point; below, its distance from the path and the speed
/// over the time. Files of gnuplot lie beside `path_prefix` meanwhile. Throws GnuplotError.
std::string drawCourse(const control::Path& path, const control::CourseRun& run, double reference_m,
                       const std::string& title, const std::string& path_prefix);

}  // namespace stereo_nav::tools
