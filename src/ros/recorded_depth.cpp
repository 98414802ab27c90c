#include "ros/recorded_depth.h"

#include <cv_bridge/cv_bridge.h>
#include <rosbag/view.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "ros/recorded_image.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

constexpr unsigned kSamples = 10;  ///< images of each camera

bool isSixteenBits(const std::string& encoding) {
  namespace enc = sensor_msgs::image_encodings;
  return encoding == enc::MONO16 || (enc::isBayer(encoding) && enc::bitDepth(encoding) == 16);
}

/// False for images of another encoding, which need no more looking.
bool addImage(const rosbag::MessageInstance& message, vision::BitDepthFinder& finder) {
  const auto image = recordedImage(message);
  if (!image || !isSixteenBits(image->encoding)) return false;
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
  cv::Mat plain = toMono8(image);  // with all checks
  if (!isSixteenBits(image->encoding) || depth.isPlain()) return plain;
  auto scaled = boost::make_shared<cv_bridge::CvImage>(
      image->header, image->encoding, vision::toFullRange(cv_bridge::toCvShare(image)->image, depth));
  return toMono8(scaled->toImageMsg());
}

}  // namespace stereo_nav::ros_io
