#pragma once

#include <string>
#include <vector>

#include "navigation/planner/plan.h"

namespace stereo_nav::navigation {

/// A path as CSV: a heading, then `x_m,y_m,heading_rad` a line, in the frame of the map.
std::string toCsv(const std::vector<PlanarPose>& poses);
/// A path in the text form of the published work: `x y` a line, in whole mm from the lower left corner of its
/// drawing.
std::string toPublishedText(const std::vector<PlanarPose>& poses);

/// Reads a path in either form, told apart by the heading of CSV. The published form has no headings, and CSV
/// need not have them: then they become those of the ways between the points. Throws InputError that names
/// the line, and for a path without points.
std::vector<PlanarPose> readPath(const std::string& path);

}  // namespace stereo_nav::navigation
