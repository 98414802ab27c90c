#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "tools/check_calibration/rig_calibration.h"

namespace stereo_nav::tools {

/// A pair of raw images from any source.
struct ImagePair {
  std::string name;
  cv::Mat left;          ///< CV_8UC1
  cv::Mat right;         ///< CV_8UC1
  double time_offset_s;  ///< right stamp minus left stamp; 0 for files
};

/// Receives pairs; returns false when no more are wanted.
using PairSink = std::function<bool(const ImagePair&)>;

/// Pairs of files in a folder: left*.EXT and right*.EXT with the same rest of the name, or equal names in
/// its folders left and right. In order of the names. Throws InputError: no pair, a file that is no
/// image.
void readFolder(const std::string& folder, const PairSink& sink);

/// Receives the camera_infos that belong to the pairs, before the first pair.
using InfoSink = std::function<void(const CameraInfos&)>;

/// Pairs of a recording, the next one at least `interval_s` after the one before.
void readBag(const std::string& path, double interval_s, const InfoSink& infos, const PairSink& sink);

/// Pairs as they come on camera/{left,right}/image_raw, paired by nearest stamp, until `duration_s` have
/// passed or Ctrl-C. An empty `infos` does without camera_info. Throws InputError when nothing comes
/// within 15 s. ros::init() must have been called.
void readTopics(double interval_s, double duration_s, const InfoSink& infos, const PairSink& sink);

}  // namespace stereo_nav::tools
