#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace stereo_nav::tools {

/// The disparity maps on camera/disparity of a bag, in the order of their stamps.
class RecordedDisparity {
 public:
  /// Throws InputError when the bag cannot be read or has no such topic.
  explicit RecordedDisparity(const std::string& path);

  /// The map with this stamp (of the left image), CV_32FC1; to be asked for in order of time. Empty where the
  /// bag has none.
  cv::Mat at(double time_s);

 private:
  std::string path_;
  rosbag::Bag bag_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
};

}  // namespace stereo_nav::tools
