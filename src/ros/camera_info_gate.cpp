#include "ros/camera_info_gate.h"

#include <utility>

#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

constexpr std::uint32_t kQueue = 20;
constexpr std::array<InfoGate::Side, 2> kBothSides = {InfoGate::kLeft, InfoGate::kRight};
constexpr std::array<const char*, 2> kInfoTopics = {topics::kLeftInfo, topics::kRightInfo};
constexpr std::array<const char*, 2> kCheckedTopics = {topics::kLeftCheckedInfo, topics::kRightCheckedInfo};
constexpr std::array<const char*, 2> kImageTopics = {topics::kLeftImage, topics::kRightImage};

}  // namespace

CameraInfoGate::CameraInfoGate(const ros::NodeHandle& handle, std::string name)
    : handle_(handle), name_(std::move(name)) {
  const ros::SubscriberStatusCallback connected = [this](const ros::SingleSubscriberPublisher&) {
    askForImages();
  };
  for (const InfoGate::Side side : kBothSides) {
    publishers_[side] =
        handle_.advertise<sensor_msgs::CameraInfo>(kCheckedTopics[side], kQueue, connected, connected);
    infos_[side] = handle_.subscribe<sensor_msgs::CameraInfo>(
        kInfoTopics[side], kQueue,
        [this, side](const sensor_msgs::CameraInfoConstPtr& info) { handleInfo(side, info); });
  }
}

bool CameraInfoGate::anybodyWaits() const {
  return publishers_[0].getNumSubscribers() > 0 || publishers_[1].getNumSubscribers() > 0;
}

void CameraInfoGate::handleInfo(InfoGate::Side side, const sensor_msgs::CameraInfoConstPtr& info) {
  publish(gate_.addInfo(side, info));
  askForImages();
  report();
}

void CameraInfoGate::handleImage(InfoGate::Side side, const sensor_msgs::ImageConstPtr& image) {
  if (!gate_.needsImages(side)) return;
  publish(gate_.addImage(side, image->header,
                         cv::Size(static_cast<int>(image->width), static_cast<int>(image->height)),
                         ros::WallTime::now().toSec()));
  askForImages();
  report();
}

/// Images flow through this process only where somebody rectifies them.
void CameraInfoGate::askForImages() {
  constexpr double kPeriod_s = 0.05;
  const bool any_wanted =
      anybodyWaits() && (gate_.needsImages(InfoGate::kLeft) || gate_.needsImages(InfoGate::kRight));
  if (any_wanted && !overdue_) {
    overdue_ = handle_.createWallTimer(ros::WallDuration(kPeriod_s), [this](const ros::WallTimerEvent&) {
      publish(gate_.passOnOverdue(ros::WallTime::now().toSec()));
    });
  } else if (!any_wanted && overdue_) {
    overdue_ = ros::WallTimer();
  }
  for (const InfoGate::Side side : kBothSides) {
    const bool wanted = gate_.needsImages(side) && anybodyWaits();
    if (wanted && !images_[side]) {
      images_[side] = handle_.subscribe<sensor_msgs::Image>(
          kImageTopics[side], kQueue,
          [this, side](const sensor_msgs::ImageConstPtr& image) { handleImage(side, image); });
    } else if (!wanted && images_[side]) {
      images_[side].shutdown();
      images_[side] = ros::Subscriber();
    }
  }
}

void CameraInfoGate::publish(const std::vector<InfoGate::Passed>& passed) {
  for (const InfoGate::Passed& one : passed) publishers_[one.side].publish(one.info);
}

void CameraInfoGate::report() {
  constexpr double kRepeat_s = 60.0;
  if (gate_.notes() != notes_said_) {
    notes_said_ = gate_.notes();
    for (const std::string& note : notes_said_) ROS_INFO_STREAM(name_ << ": " << note);
  }
  const ros::WallTime now = ros::WallTime::now();
  const bool again = gate_.problem() != problem_said_ || (now - said_at_).toSec() > kRepeat_s;
  if (!anybodyWaits() || !again) return;
  problem_said_ = gate_.problem();
  said_at_ = now;
  if (problem_said_.empty()) return;
  ROS_ERROR_STREAM(name_ << ": nothing is rectified: " << problem_said_);
}

}  // namespace stereo_nav::ros_io
