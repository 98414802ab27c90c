#include "tools/evaluate/recorded_disparity.h"

#include <cv_bridge/cv_bridge.h>
#include <stereo_msgs/DisparityImage.h>

#include <vector>

#include "ros/bag_structure.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {
namespace {

constexpr double kSameStamp_s = 1e-6;

}  // namespace

RecordedDisparity::RecordedDisparity(const std::string& path) : path_(path) {
  ros_io::readBag(path, [&] {
    ros_io::openBag(bag_, path);
    view_ = std::make_unique<rosbag::View>(
        bag_, rosbag::TopicQuery(std::vector<std::string>{"camera/disparity", "/camera/disparity"}));
  });
  if (view_->size() == 0) {
    throw InputError(path + ": no messages on camera/disparity; record that topic, too");
  }
  next_ = view_->begin();
}

cv::Mat RecordedDisparity::at(double time_s) {
  for (; next_ != view_->end(); ++next_) {
    const auto message = next_->instantiate<stereo_msgs::DisparityImage>();
    if (!message) throw InputError(path_ + ": camera/disparity is no stereo_msgs/DisparityImage");
    const double stamp_s = message->header.stamp.toSec();
    if (stamp_s > time_s + kSameStamp_s) break;
    if (stamp_s > time_s - kSameStamp_s) return cv_bridge::toCvCopy(message->image, "32FC1")->image;
  }
  return cv::Mat();
}

}  // namespace stereo_nav::tools
