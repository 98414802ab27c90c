#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {

struct DepthAtOptions {
  std::string bag;                 ///< empty: live topics
  std::optional<cv::Point> pixel;  ///< absent, live only: wherever is clicked
  int window_px = 5;
  int disparity_range = 0;        ///< of a recording; 0: as configured
  ros_io::RecordingOptions part;  ///< of a recording
  bool each = false;
  int frames = 30;  ///< live: to collect
  bool live() const { return bag.empty(); }
};

/// Nothing when help was asked for and printed. Throws InputError with one line for bad arguments.
std::optional<DepthAtOptions> parseDepthAtOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
