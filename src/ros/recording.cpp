#include "stereo_nav/ros/recording.h"

#include <fmt/format.h>
#include <rosbag/view.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "ros/bag_structure.h"
#include "ros/judged_infos.h"
#include "ros/recorded_depth.h"
#include "ros/recorded_image.h"
#include "ros/recorded_imu.h"
#include "ros/recorded_poses.h"
#include "ros/recorded_transforms.h"
#include "ros/rig_topics.h"
#include "ros/setup_checks.h"
#include "ros/usable_stamps.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// All three stamps of each message.
void straightenSync(const RecordedClock& clock, std::vector<StereoSync>& sync) {
  using StampOf = ros::Time& (*)(StereoSync&);
  for (const StampOf stamp_of : {StampOf([](StereoSync& pair) -> ros::Time& { return pair.header.stamp; }),
                                 StampOf([](StereoSync& pair) -> ros::Time& { return pair.left_stamp; }),
                                 StampOf([](StereoSync& pair) -> ros::Time& { return pair.right_stamp; })}) {
    std::vector<ros::Time> stamps;
    for (StereoSync& pair : sync) stamps.push_back(stamp_of(pair));
    clock.straighten(stamps);
    for (std::size_t i = 0; i < sync.size(); ++i) stamp_of(sync[i]) = stamps[i];
  }
}

}  // namespace

Recording::Recording(const std::string& path, const RecordingOptions& options) : path_(path) {
  readBag(path, [&] {
    openBag(bag_, path);
    findTopics(options);
    readMessages();
    const vision::BitDepth depth = recordedDepth(bag_, topics_.left, topics_.right);
    mono16_bits_ = depth.bits;
    mono16_swapped_ = depth.swapped;
    readImu();
    readStaticTransforms(bag_, transforms_, notes_);
    pairImages(options);
  });
}

std::string Recording::topicList() const {
  return all_topics_.empty() ? "nothing" : fmt::format("{}", fmt::join(all_topics_, ", "));
}

std::optional<std::string> Recording::find(const std::string& relative_name) const {
  for (const std::string& topic : all_topics_) {
    const std::string name = withoutSlash(topic);
    if (name == rig_prefix_ + relative_name || (several_rigs_ && name == relative_name)) return topic;
  }
  if (several_rigs_) return std::nullopt;  // another rig's would be wrong
  for (const std::string& topic : all_topics_) {
    if (topic == relative_name || endsWith(topic, "/" + relative_name)) return topic;
  }
  return std::nullopt;
}

std::string Recording::require(const std::string& relative_name) const {
  const auto topic = find(relative_name);
  if (topic) return *topic;
  throw InputError(path_ + ": no topic " + relative_name + "; the bag holds " + topicList() +
                   ". Record both cameras' image_raw and camera_info");
}

std::string Recording::requireImages(const std::string& relative_name) const {
  if (const auto plain = find(relative_name)) return *plain;
  const auto compressed = find(relative_name + topics::kCompressed);
  return compressed ? *compressed : require(relative_name);
}

void Recording::findTopics(const RecordingOptions& options) {
  std::set<std::string> names;
  rosbag::View view(bag_);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) names.insert(connection->topic);
  all_topics_.assign(names.begin(), names.end());
  several_rigs_ = rigNamespaces(all_topics_).size() > 1;
  try {
    rig_prefix_ = chooseRig(all_topics_, options.rig);
  } catch (const InputError& error) {
    throw InputError(path_ + ": " + error.what());
  }
  if (!rig_prefix_.empty()) rig_prefix_ += "/";
  topics_.left = requireImages(topics::kLeftImage);
  topics_.right = requireImages(topics::kRightImage);
  topics_.left_info = require(topics::kLeftInfo);
  topics_.right_info = require(topics::kRightInfo);
  topics_.sync = find(topics::kSync);
  topics_.imu = find(topics::kImu);
  topics_.imu_quat = find(topics::kImuQuaternion);
}

sensor_msgs::CameraInfo Recording::firstInfo(const std::string& topic) {
  rosbag::View view(bag_, rosbag::TopicQuery(topic));
  std::optional<sensor_msgs::CameraInfo> empty_one;
  std::size_t empty = 0;
  for (const rosbag::MessageInstance& message : view) {
    const auto info = message.instantiate<sensor_msgs::CameraInfo>();
    if (!info) continue;
    if (isCalibrated(*info)) {
      if (empty > 0) {
        notes_.push_back(topic + ": the first " + std::to_string(empty) +
                         " messages are all zero; the calibration of the later ones is used for all frames");
      }
      return *info;
    }
    ++empty;
    if (!empty_one) empty_one = *info;
  }
  if (empty_one) return *empty_one;
  throw InputError(path_ + ": " + topic + " holds no sensor_msgs/CameraInfo");
}

void Recording::readMessages() {
  left_info_ = firstInfo(topics_.left_info);
  right_info_ = firstInfo(topics_.right_info);
  std::vector<ReceivedStamp> left_images;
  order_ = RecordedOrder(bag_, topics_.left);
  order_.forEach(bag_, {topics_.left, topics_.right},
                 [&](const rosbag::MessageInstance& message, const ros::Time& received) {
                   const auto stamp = recordedImageStamp(message);
                   if (!stamp) {
                     throw InputError(path_ + ": " + message.getTopic() + " is " + message.getDataType() +
                                      ", expected sensor_msgs/Image or sensor_msgs/CompressedImage");
                   }
                   const bool is_left = message.getTopic() == topics_.left;
                   (is_left ? left_stamps_ : right_stamps_).push_back(*stamp);
                   if (is_left) left_images.push_back({*stamp, received});
                 });
  if (left_stamps_.empty() || right_stamps_.empty()) {
    throw InputError(path_ + ": " + std::to_string(left_stamps_.size()) + " left and " +
                     std::to_string(right_stamps_.size()) + " right images; both cameras are needed");
  }
  clock_ = RecordedClock(left_images);
  clock_.straighten(left_stamps_);
  clock_.straighten(right_stamps_);
  left_in_order_ = left_stamps_;
  right_in_order_ = right_stamps_;
  if (stretches() > 1) {
    notes_.push_back("the clock of the recorded computer was set back (times: " +
                     std::to_string(stretches() - 1) + "); what follows is taken in the order of recording" +
                     (order_.setBacks() > 0 ? ", its first image as one interval after the last one before"
                                            : ", by the times of receipt"));
  }
}

void Recording::readImu() {
  if (!topics_.imu && !topics_.imu_quat) return;
  const std::string topic = topics_.imu ? *topics_.imu : *topics_.imu_quat;
  RecordedImu recorded = readRecordedImu(bag_, order_, path_, topic);
  imu_ = std::move(recorded.samples);
  imu_frame_ = std::move(recorded.frame);
  clock_.straighten(imu_, [](ImuSample& sample) -> double& { return sample.time_s; });
  std::stable_sort(imu_.begin(), imu_.end(),
                   [](const ImuSample& a, const ImuSample& b) { return a.time_s < b.time_s; });
}

void Recording::pairImages(const RecordingOptions& options) {
  std::vector<StereoSync> sync;
  if (topics_.sync) {
    order_.forEach(bag_, {*topics_.sync}, [&](const rosbag::MessageInstance& message, const ros::Time&) {
      const auto pair = message.instantiate<StereoSync>();
      if (!pair) {
        throw InputError(
            path_ + ": " + *topics_.sync + " is " + message.getDataType() +
            " of another version of stereo_nav; leave the topic out (rosbag filter IN.bag "
            "OUT.bag \"topic != '" +
            *topics_.sync +
            "'\"): the images are then paired by their own stamps, which is right for synchronised cameras");
      }
      sync.push_back(*pair);
    });
  }
  straightenSync(clock_, sync);
  const std::size_t images = left_stamps_.size() + right_stamps_.size();
  keepUsableStamps(path_ + ": " + topics_.left, left_stamps_, notes_);
  keepUsableStamps(path_ + ": " + topics_.right, right_stamps_, notes_);
  pairs_ = pairStamps(left_stamps_, right_stamps_, sync);
  unpaired_images_ = images - 2 * pairs_.size();
  if (pairs_.empty()) {
    std::ostringstream message;
    message.precision(15);
    message << path_ << ": no left image has a right one: left stamps begin at "
            << left_stamps_.front().toSec() << " s, right ones at " << right_stamps_.front().toSec()
            << " s; are the cameras stamped by one clock?";
    throw InputError(message.str());
  }
  for (StampPair& pair : pairs_) {
    pair.rolling_shutter_s = options.rolling_shutter_s.value_or(pair.rolling_shutter_s);
  }
  const double from_s = left_stamps_.front().toSec() + options.start_s;
  const double to_s = from_s + options.duration_s;
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(),
                              [&](const StampPair& pair) {
                                return pair.left_time_s < from_s || pair.left_time_s > to_s;
                              }),
               pairs_.end());
  if (pairs_.empty()) {
    std::ostringstream message;
    message << path_ << ": no frame between --start and --start + --duration; the recording lasts "
            << (left_stamps_.back() - left_stamps_.front()).toSec() << " s";
    throw InputError(message.str());
  }
  std::vector<double> times_s;
  for (const StampPair& pair : pairs_) times_s.push_back(pair.left_time_s);
  notePauses(times_s, notes_);
}

std::optional<Eigen::Isometry3d> Recording::transform(const std::string& target,
                                                      const std::string& source) const {
  try {
    return toIsometry(
        transforms_.lookupTransform(withoutSlash(target), withoutSlash(source), ros::Time(0)).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

Recording::GroundTruth Recording::groundTruth(const std::string& topic, bool required) const {
  const auto found = find(
      topic.substr(topic.find_first_not_of('/') == std::string::npos ? 0 : topic.find_first_not_of('/')));
  if (!found) {
    if (!required) return {};
    throw InputError(path_ + ": no ground truth topic " + topic + " (and no such file); the bag holds " +
                     topicList());
  }
  RecordedPoses recorded = readRecordedPoses(bag_, order_, path_, *found);
  GroundTruth truth{std::move(recorded.trajectory), std::move(recorded.body_frame)};
  clock_.straighten(truth.trajectory, [](StampedPose& pose) -> double& { return pose.time_s; });
  return truth;
}

void Recording::forEachPair(const std::function<void(const RawPair&)>& handle) const {
  // Messages come in the order of recording; an image waits here until its partner has been read.
  std::map<std::size_t, sensor_msgs::ImageConstPtr> waiting_left;
  std::map<std::size_t, sensor_msgs::ImageConstPtr> waiting_right;
  std::map<ros::Time, std::size_t> pair_of_left;
  std::map<ros::Time, std::size_t> pair_of_right;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    pair_of_left[left_stamps_[pairs_[i].left]] = i;
    pair_of_right[right_stamps_[pairs_[i].right]] = i;
  }
  std::size_t next = 0;
  std::size_t left_images = 0;
  std::size_t right_images = 0;
  const vision::BitDepth depth{mono16_bits_, mono16_swapped_};
  order_.forEach(
      bag_, {topics_.left, topics_.right}, [&](const rosbag::MessageInstance& message, const ros::Time&) {
        const bool is_left = message.getTopic() == topics_.left;
        auto& pair_of = is_left ? pair_of_left : pair_of_right;
        const auto pair =
            pair_of.find(is_left ? left_in_order_[left_images++] : right_in_order_[right_images++]);
        if (pair == pair_of.end()) return;
        (is_left ? waiting_left : waiting_right)[pair->second] = recordedImage(message);
        pair_of.erase(pair);  // a second image with this stamp is left out
        while (waiting_left.count(next) != 0 && waiting_right.count(next) != 0) {
          handle({pairs_[next].left_time_s, pairs_[next].right_time_s, pairs_[next].rolling_shutter_s,
                  toMono8(waiting_left[next], depth), toMono8(waiting_right[next], depth)});
          waiting_left.erase(next);
          waiting_right.erase(next);
          ++next;
        }
      });
}

}  // namespace stereo_nav::ros_io
