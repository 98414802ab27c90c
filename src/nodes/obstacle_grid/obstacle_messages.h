#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>

#include <optional>
#include <vector>

#include "navigation/obstacles/obstacle_map.h"

namespace stereo_nav::nodes {

/// The beams of a scan into `beams`: infinity is nothing up to the largest range (REP-117); NaN, and what is
/// nearer than the smallest range, says nothing. Beams that meet nothing count up to `free_range_m` at the
/// most.
void toBeams(const sensor_msgs::LaserScan& scan, double free_range_m, std::vector<navigation::Beam>& beams);
/// The same of a range finder.
std::optional<navigation::Beam> toBeam(const sensor_msgs::Range& range, double free_range_m);

}  // namespace stereo_nav::nodes
