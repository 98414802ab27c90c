#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mapping/loop/loop_params.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {

struct FindLoopsOptions {
  std::string input;   ///< bag, or folder of images
  std::string output;  ///< folder
  mapping::LoopParams loop;
  int pictures = 20;  ///< of accepted loops at most

  // Of a bag.
  std::string config;  ///< path of the odometry's parameter file
  ros_io::RecordingOptions part;
  std::optional<std::string> ground_truth, ground_truth_frame;
  bool no_imu = false;
  double near_m = 1.0, near_deg = 20.0;  ///< truth: keyframes within both show the same place

  // Of a folder.
  int features = 1000;
  int threshold = 10;  ///< grey levels, of the corners
  double epipolar_px = 1.5;
  std::vector<std::size_t> same_after;  ///< truth: images so far apart show the same place; empty: unknown
  std::size_t same_within = 2;
};

/// Nothing when help was asked for and printed. Throws InputError, ParameterError.
std::optional<FindLoopsOptions> parseFindLoopsOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
