#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <optional>

#include "ros/frame_synchroniser.h"
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
  /// A pair is handed out once.
  std::optional<ImagePair> takeNewest() {
    if (!newest_) return std::nullopt;
    // Copies: grey images share their pixels with the messages, which the next pair replaces.
    ImagePair pair{fmt::format("{:.3f}", newest_->left_stamp.toSec()), ros_io::toMono8(newest_->left).clone(),
                   ros_io::toMono8(newest_->right).clone(),
                   (newest_->right_stamp - newest_->left_stamp).toSec()};
    newest_.reset();
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
  static constexpr int kQueue = 5;

  /// Wider than the odometry's own limit: a pair that is badly apart is judged rather than left out.
  static ros_io::FrameSynchroniserParams pairing() {
    ros_io::FrameSynchroniserParams params;
    params.max_time_offset_s = 0.5;
    params.disparity = odometry::DisparityUse::kNone;
    return params;
  }

  void takePairs() {
    while (auto frame = pairs_.take()) newest_ = std::move(frame);
  }

  ros::NodeHandle handle_;
  ros_io::FrameSynchroniser pairs_{pairing()};
  std::optional<ros_io::FrameMessages> newest_;
  std::size_t left_images_ = 0, right_images_ = 0;
  ros::Subscriber left_ =
      handle_.subscribe<Image>(topics::kLeftImage, kQueue, [this](const Image::ConstPtr& image) {
        ++left_images_;
        pairs_.addLeft(image, ros_io::SteadyTime::clock::now());
        takePairs();
      });
  ros::Subscriber right_ =
      handle_.subscribe<Image>(topics::kRightImage, kQueue, [this](const Image::ConstPtr& image) {
        ++right_images_;
        pairs_.addRight(image);
        takePairs();
      });
  ros::Subscriber sync_ =
      handle_.subscribe<StereoSync>(topics::kSync, kQueue, [this](const StereoSyncConstPtr& sync) {
        pairs_.addSync(sync);
        takePairs();
      });
  CameraInfo::ConstPtr left_info_, right_info_;
  ros::Subscriber left_info_subscriber_ = handle_.subscribe<CameraInfo>(
      topics::kLeftInfo, 1, [this](const CameraInfo::ConstPtr& info) { left_info_ = info; });
  ros::Subscriber right_info_subscriber_ = handle_.subscribe<CameraInfo>(
      topics::kRightInfo, 1, [this](const CameraInfo::ConstPtr& info) { right_info_ = info; });
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
