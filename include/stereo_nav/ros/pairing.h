#pragma once

#include <ros/time.h>

#include <cstddef>
#include <vector>

#include "stereo_nav/StereoSync.h"

namespace stereo_nav::ros_io {

/// A pair: indices into the lists of left and right image stamps, and when the images were taken.
struct StampPair {
  std::size_t left;                ///< index of the left stamp
  std::size_t right;               ///< index of the right stamp
  double left_time_s;              ///< when the left image was taken
  double right_time_s;             ///< when the right image was taken
  double rolling_shutter_s = 0.0;  ///< from the first row to the last
};

/// Pairs the images of a recording, each image at most once; the result is in order of the left stamps. Where
/// there are `sync` messages, they decide: an image belongs to a message if it carries the pair's common
/// stamp or its own true stamp. Without them, left and right are paired by nearest stamp, closest pairs
/// first, up to half the left camera's median period apart. Both lists of stamps must be in order of time.
std::vector<StampPair> pairStamps(const std::vector<ros::Time>& left, const std::vector<ros::Time>& right,
                                  const std::vector<StereoSync>& sync);

}  // namespace stereo_nav::ros_io
