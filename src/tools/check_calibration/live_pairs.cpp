#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <boost/bind/bind.hpp>
#include <optional>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/topics.h"
#include "tools/check_calibration/image_pairs.h"

namespace stereo_nav::tools {
namespace {

namespace topics = ros_io::topics;
using sensor_msgs::CameraInfo;
using sensor_msgs::Image;

/// The newest pair and the newest camera_infos of the running cameras.
class Listener {
 public:
  Listener() {
    using boost::placeholders::_1;
    using boost::placeholders::_2;
    pairs_.registerCallback(boost::bind(&Listener::takePair, this, _1, _2));
    left_.registerCallback([this](const Image::ConstPtr&) { ++left_images_; });
    right_.registerCallback([this](const Image::ConstPtr&) { ++right_images_; });
  }

  /// A pair is handed out once.
  std::optional<ImagePair> takeNewest() {
    if (!left_image_) return std::nullopt;
    char name[40];
    std::snprintf(name, sizeof name, "%.3f", left_image_->header.stamp.toSec());
    // Copies: grey images share their pixels with the messages, which the next pair replaces.
    ImagePair pair{name, ros_io::toMono8(left_image_).clone(), ros_io::toMono8(right_image_).clone(),
                   (right_image_->header.stamp - left_image_->header.stamp).toSec()};
    left_image_.reset();
    return pair;
  }

  std::optional<CameraInfos> infos() const {
    if (!left_info_ || !right_info_) return std::nullopt;
    return CameraInfos{*left_info_, *right_info_};
  }

  /// Describes for the error message what has come and what has not.
  std::string seen() const {
    return std::to_string(left_images_) + " images on " + handle_.resolveName(topics::kLeftImage) + ", " +
           std::to_string(right_images_) + " on " + handle_.resolveName(topics::kRightImage) +
           ", camera_info " +
           (infos()       ? "of both"
            : left_info_  ? "of the left only"
            : right_info_ ? "of the right only"
                          : "of neither");
  }

 private:
  using Policy = message_filters::sync_policies::ApproximateTime<Image, Image>;
  static constexpr int kQueue = 5;

  void takePair(const Image::ConstPtr& left, const Image::ConstPtr& right) {
    left_image_ = left;
    right_image_ = right;
  }

  ros::NodeHandle handle_;
  message_filters::Subscriber<Image> left_{handle_, topics::kLeftImage, kQueue};
  message_filters::Subscriber<Image> right_{handle_, topics::kRightImage, kQueue};
  message_filters::Synchronizer<Policy> pairs_{Policy(kQueue), left_, right_};
  CameraInfo::ConstPtr left_info_, right_info_;
  ros::Subscriber left_info_subscriber_ = handle_.subscribe<CameraInfo>(
      topics::kLeftInfo, 1, [this](const CameraInfo::ConstPtr& info) { left_info_ = info; });
  ros::Subscriber right_info_subscriber_ = handle_.subscribe<CameraInfo>(
      topics::kRightInfo, 1, [this](const CameraInfo::ConstPtr& info) { right_info_ = info; });
  Image::ConstPtr left_image_, right_image_;
  std::size_t left_images_ = 0, right_images_ = 0;
};

}  // namespace

void readTopics(double interval_s, double duration_s, const InfoSink& infos, const PairSink& sink) {
  constexpr double kPatience_s = 15.0;
  Listener listener;
  const ros::WallTime start = ros::WallTime::now();
  ros::WallTime next = start;
  bool begun = false;
  while (ros::ok() && (ros::WallTime::now() - start).toSec() < duration_s) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    if (!begun && (ros::WallTime::now() - start).toSec() > kPatience_s) {
      throw InputError("no pair within " + std::to_string(static_cast<int>(kPatience_s)) +
                       " s: " + listener.seen() + "; is capture.launch running, in this namespace?");
    }
    if (ros::WallTime::now() < next || (!begun && infos && !listener.infos())) continue;
    const auto pair = listener.takeNewest();
    if (!pair) continue;
    if (!begun && infos) infos(*listener.infos());
    begun = true;
    if (!sink(*pair)) return;
    next = ros::WallTime::now() + ros::WallDuration(interval_s);
  }
}

}  // namespace stereo_nav::tools
