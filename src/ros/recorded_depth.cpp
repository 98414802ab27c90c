#include "ros/recorded_depth.h"

#include <cv_bridge/cv_bridge.h>
#include <rosbag/view.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

constexpr unsigned kSamples = 10;  ///< images of each camera

/// False for images of another encoding, which need no more looking.
bool addImage(const rosbag::MessageInstance& message, vision::BitDepthFinder& finder) {
  namespace enc = sensor_msgs::image_encodings;
  const auto image = message.instantiate<sensor_msgs::Image>();
  if (!image || image->encoding != enc::MONO16) return false;
  try {
    finder.add(cv_bridge::toCvShare(image)->image);
  } catch (const cv_bridge::Exception&) {
    return false;  // damaged: toMono8() says so when its turn comes
  }
  return true;
}

}  // namespace

vision::BitDepth recordedDepth(const rosbag::Bag& bag, const std::string& left, const std::string& right) {
  vision::BitDepthFinder finder;
  for (const std::string& topic : {left, right}) {
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    const unsigned step = std::max(1U, view.size() / kSamples);
    unsigned index = 0;
    for (const rosbag::MessageInstance& message : view) {
      if (index++ % step == 0 && !addImage(message, finder)) break;
    }
  }
  return finder.depth();
}

cv::Mat toMono8(const sensor_msgs::ImageConstPtr& image, const vision::BitDepth& depth) {
  namespace enc = sensor_msgs::image_encodings;
  cv::Mat plain = toMono8(image);  // with all checks
  if (image->encoding != enc::MONO16 || depth.isPlain()) return plain;
  cv::Mat grey;
  vision::toFullRange(cv_bridge::toCvShare(image)->image, depth).convertTo(grey, CV_8U, 255.0 / 65535.0);
  return grey;
}

}  // namespace stereo_nav::ros_io
