#pragma once

#include <ros/time.h>

#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Sorts the stamps of a topic's images and leaves out those that are 0 and all but one of equal ones; a line
/// for each kind is added to `notes`. Throws InputError when none is left.
void keepUsableStamps(const std::string& topic, std::vector<ros::Time>& stamps,
                      std::vector<std::string>& notes);

/// A line for each pause of more than a second between one pair and the next, whose stamps are `times_s`:
/// what moved meanwhile is not in the path, and where the clock of the recording computer was set, the
/// stretches may lie in another order.
void notePauses(const std::vector<double>& times_s, std::vector<std::string>& notes);

}  // namespace stereo_nav::ros_io
