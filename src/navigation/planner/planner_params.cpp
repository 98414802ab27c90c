#include "navigation/planner/planner_params.h"

#include <sstream>

#include "core/text_table.h"

namespace stereo_nav::navigation {

void PlannerParams::describe(ParameterVisitor& visitor) {
  visitor.real("footprint_length_m", footprint_length_m, {0.01, 20.0}, "m",
               "size of the robot along x, centred on base_link");
  visitor.real("footprint_width_m", footprint_width_m, {0.01, 20.0}, "m",
               "size of the robot along y, centred on base_link");
  visitor.text(
      "footprint", footprint,
      "outline of the robot, instead of length and width: its corners `x y x y x y ...` in base_link, in m; dents are filled");
  visitEnum(
      visitor, "heading", heading, {{"travel", HeadingRule::kTravel}, {"kept", HeadingRule::kKept}},
      "travel: the robot faces where it drives to; kept: it keeps its heading, as swerve, mecanum and omni drives can");
  visitEnum(visitor, "unknown", unknown,
            {{"obstacle", grid::UnknownSpace::kAsObstacle}, {"free", grid::UnknownSpace::kAsFree}},
            "what cells of which nothing is known count as, and all beyond the edge of the map");
  visitSection(visitor, "clearance", clearance);
  visitSection(visitor, "search", search);
  visitor.real(
      "goal_tolerance_m", goal_tolerance_m, {0.0, 10.0}, "m",
      "a goal that is not free is replaced by the nearest point that can be reached, if it is within this");
  visitor.real("leave_within_m", leave_within_m, {0.0, 10.0}, "m",
               "a robot that touches obstacles at the start is led away from them at most this far");
  visitor.real("shortcut_slack", shortcut_slack, {0.0, 1.0}, "",
               "a straight way may cost this share more than the points that it replaces");
  visitor.real(
      "better_by", better_by, {0.0, 1.0}, "",
      "share of its cost by which another way must be better before a way that is free is given up; doubles at each such change");
}

grid::Footprint PlannerParams::makeFootprint() const {
  if (footprint.empty()) return grid::Footprint::rectangle(footprint_length_m, footprint_width_m);
  std::istringstream text(footprint);
  grid::Polygon corners;
  for (const TextRow& row : readTextTable(text, "footprint"))
    for (std::size_t i = 0; i < row.fields.size(); i += 2)
      corners.emplace_back(row.number(i), row.number(i + 1));
  return grid::Footprint(corners);
}

}  // namespace stereo_nav::navigation
