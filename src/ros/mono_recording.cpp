#include "ros/mono_recording.h"

#include <rosbag/view.h>

#include <algorithm>
#include <map>

#include "ros/bag_structure.h"
#include "ros/recorded_depth.h"
#include "ros/recorded_image.h"
#include "ros/setup_checks.h"
#include "ros/usable_stamps.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

constexpr const char* kOneImage = "camera/image_raw";
constexpr const char* kInfo = "camera_info";

}  // namespace

MonoRecording::MonoRecording(const std::string& path, const MonoRecordingOptions& options) : robot_(path) {
  readBag(path, [&] {
    findImages();
    readStamps(options);
    readInfo();
    readReadout(options);
    readMotion();
  });
}

void MonoRecording::findImages() {
  for (const std::string& name : {std::string(topics::kLeftImage), std::string(kOneImage)}) {
    for (const std::string& topic : {name, name + topics::kCompressed}) {
      const auto found = image_topic_.empty() ? robot_.find(topic) : std::nullopt;
      if (!found) continue;
      image_topic_ = *found;
      info_topic_ = found->substr(0, found->find("image_raw")) + kInfo;
    }
  }
  if (!image_topic_.empty()) return;
  image_topic_ = robot_.onlyOfType("sensor_msgs/Image", "").value_or("");
  info_topic_ = robot_.onlyOfType("sensor_msgs/CameraInfo", "").value_or("");
  if (image_topic_.empty() || info_topic_.empty())
    throw InputError(robot_.path() + ": neither " + topics::kLeftImage + " nor " + kOneImage +
                     ", nor a single image topic with its camera_info; the bag holds " + robot_.topicList() +
                     ". Record a camera's image_raw and camera_info");
}

void MonoRecording::readStamps(const MonoRecordingOptions& options) {
  std::vector<ReceivedStamp> received_stamps;
  std::vector<ros::Time> stamps;
  robot_.orderBy(image_topic_);
  robot_.order().forEach(robot_.bag(), {image_topic_},
                         [&](const rosbag::MessageInstance& message, const ros::Time& received) {
                           const auto stamp = recordedImageStamp(message);
                           if (!stamp)
                             throw InputError(robot_.path() + ": " + image_topic_ + " is " +
                                              message.getDataType() + ", expected sensor_msgs/Image");
                           stamps.push_back(*stamp);
                           received_stamps.push_back({*stamp, received});
                         });
  robot_.setClock(received_stamps);
  robot_.clock().straighten(stamps);
  keepUsableStamps(robot_.path() + ": " + image_topic_, stamps, robot_.notes());
  const double from_s = stamps.front().toSec() + options.start_s;
  for (const ros::Time& stamp : stamps) {
    const double time_s = stamp.toSec();
    if (time_s >= from_s && time_s <= from_s + options.duration_s) times_s_.push_back(time_s);
  }
  if (times_s_.size() < 2)
    throw InputError(robot_.path() + ": less than two images between --start and --start + --duration");
  notePauses(times_s_, robot_.notes());
}

void MonoRecording::readInfo() {
  sensor_msgs::CameraInfo::ConstPtr info;
  rosbag::View view(robot_.bag(), rosbag::TopicQuery(info_topic_));
  for (const rosbag::MessageInstance& message : view) {
    info = message.instantiate<sensor_msgs::CameraInfo>();
    if (info && info->K[0] != 0.0) break;  // drivers publish zeros until they have read their calibration
  }
  if (!info) throw InputError(robot_.path() + ": " + info_topic_ + " holds no sensor_msgs/CameraInfo");
  view_.emplace(info_topic_, *info);
  robot_.notes().insert(robot_.notes().end(), view_->notes().begin(), view_->notes().end());
  T_base_camera_ = robot_.T_base(withoutSlash(info->header.frame_id));
}

void MonoRecording::readReadout(const MonoRecordingOptions& options) {
  const auto sync = robot_.find(topics::kSync);
  if (sync) {
    rosbag::View view(robot_.bag(), rosbag::TopicQuery(*sync));
    const auto first = view.size() > 0 ? view.begin()->instantiate<StereoSync>() : nullptr;
    if (first) readout_s_ = first->rolling_shutter_s;
  }
  readout_s_ = options.rolling_shutter_s.value_or(readout_s_);
}

void MonoRecording::readMotion() {
  if (const auto topic = robot_.find(topics::kImu)) {
    imu_ = robot_.imu(*topic, times_s_.front(), times_s_.back());
    if (!imu_.set_aside.empty()) robot_.notes().push_back("the IMU is set aside: " + imu_.set_aside);
  }
  wheels_ = robot_.poses(topics::kWheelOdometry, false).trajectory;
  std::stable_sort(wheels_.begin(), wheels_.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.time_s < b.time_s; });
}

void MonoRecording::forEachImage(const std::function<void(const MonoImage&)>& handle) const {
  const vision::BitDepth depth = recordedDepth(robot_.bag(), image_topic_, image_topic_);
  // Messages come in the order of recording, and the stamps of a camera increase in it.
  std::vector<ros::Time> stamps;
  robot_.order().forEach(robot_.bag(), {image_topic_},
                         [&](const rosbag::MessageInstance& message, const ros::Time&) {
                           stamps.push_back(recordedImageStamp(message).value_or(ros::Time()));
                         });
  robot_.clock().straighten(stamps);
  std::size_t index = 0;
  std::size_t next = 0;
  robot_.order().forEach(robot_.bag(), {image_topic_},
                         [&](const rosbag::MessageInstance& message, const ros::Time&) {
                           const double time_s = stamps[index++].toSec();
                           if (next == times_s_.size() || time_s != times_s_[next]) return;
                           ++next;
                           handle({time_s, view_->rectify(toMono8(recordedImage(message), depth))});
                         });
}

}  // namespace stereo_nav::ros_io
