#include "nodes/visual_odometry/disparity_view.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "nodes/visual_odometry/debug_views.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kLookPeriod_s = 0.25;

/// CV_32FC1 in px, unknown below zero; empty for a message of another format.
cv::Mat mapOf(const stereo_msgs::DisparityImage& message) {
  const sensor_msgs::Image& image = message.image;
  const bool fits = image.encoding == sensor_msgs::image_encodings::TYPE_32FC1 &&
                    image.step >= image.width * sizeof(float) &&
                    image.data.size() >= static_cast<std::size_t>(image.step) * image.height;
  if (!fits) return {};
  // The Mat is only read; OpenCV has no constructor for constant data.
  const cv::Mat shared(static_cast<int>(image.height), static_cast<int>(image.width), CV_32FC1,
                       const_cast<unsigned char*>(image.data.data()), image.step);
  cv::Mat map = shared.clone();
  constexpr double kHalfStep = 0.5;  // unknown pixels lie a whole pixel below the smallest disparity
  map.setTo(-1.0F, map < std::max(0.0, message.min_disparity - kHalfStep));
  return map;
}

}  // namespace

DisparityView::DisparityView(const ros::NodeHandle& handle)
    : handle_(handle), transport_(handle_), publisher_(transport_.advertise("vo/disparity_view", 2)) {
  // All of this runs in the thread of the node's callbacks; connection callbacks come from other threads.
  timer_ = handle_.createWallTimer(ros::WallDuration(kLookPeriod_s),
                                   [this](const ros::WallTimerEvent&) { followSubscribers(); });
}

void DisparityView::followSubscribers() {
  const bool wanted = publisher_.getNumSubscribers() > 0;
  if (!wanted) {
    subscriber_.shutdown();
  } else if (!subscriber_) {
    subscriber_ = handle_.subscribe("camera/disparity", 1, &DisparityView::handleDisparity, this,
                                    ros::TransportHints().tcpNoDelay());
  }
}

void DisparityView::handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  const cv::Mat map = mapOf(*disparity);
  if (map.empty()) return;
  publisher_.publish(
      cv_bridge::CvImage(disparity->header, sensor_msgs::image_encodings::BGR8, colourDisparity(map))
          .toImageMsg());
}

}  // namespace stereo_nav::nodes
