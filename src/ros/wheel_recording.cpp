#include "ros/wheel_recording.h"

#include <fmt/format.h>
#include <rosbag/view.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <set>

#include "odometry/wheel/imu_yaw.h"
#include "ros/bag_structure.h"
#include "ros/imu_checks.h"
#include "ros/recorded_imu.h"
#include "ros/recorded_transforms.h"
#include "ros/setup_checks.h"
#include "ros/wheel_ticks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

/// In order of time, each stamp once; a note says what is left out.
void keepIncreasing(std::vector<odometry::WheelSample>& samples, std::vector<std::string>& notes) {
  const std::size_t all = samples.size();
  std::stable_sort(samples.begin(), samples.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  samples.erase(std::unique(samples.begin(), samples.end(),
                            [](const auto& a, const auto& b) { return a.time_s == b.time_s; }),
                samples.end());
  if (samples.size() != all)
    notes.push_back(
        std::to_string(all - samples.size()) +
        " readings of the wheels repeat a stamp and are left out; does their driver stamp each once?");
}

}  // namespace

WheelRecording::WheelRecording(const std::string& path, const kinematics::DriveParams& drive,
                               const WheelRecordingOptions& options)
    : path_(path) {
  readBag(path, [&] {
    openBag(bag_, path);
    std::set<std::string> names;
    for (const rosbag::ConnectionInfo* connection : rosbag::View(bag_).getConnections())
      names.insert(connection->topic);
    topics_.assign(names.begin(), names.end());
    readStaticTransforms(bag_, transforms_, notes_);
    readTicks(drive, options);
    if (options.imu) addYaw();
  });
}

std::optional<std::string> WheelRecording::find(const std::string& name) const {
  std::vector<std::string> found;
  for (const std::string& topic : topics_) {
    const std::string end = "/" + name;
    const bool ends =
        topic.size() >= end.size() && topic.compare(topic.size() - end.size(), end.size(), end) == 0;
    if (ends || topic == name) found.push_back(topic);
  }
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return found.front();
  throw InputError(path_ + ": several topics are a " + name + ": " + listed(found) +
                   "; keep one robot's topics (rosbag filter)");
}

void WheelRecording::readTicks(const kinematics::DriveParams& drive, const WheelRecordingOptions& options) {
  const auto topic = find(topics::kWheelTicks);
  if (!topic) {
    throw InputError(path_ + ": no topic " + topics::kWheelTicks + "; the bag holds " + listed(topics_) +
                     ". Record what publishes the encoders");
  }
  std::vector<ReceivedStamp> stamps;
  order_ = RecordedOrder(bag_, *topic);
  order_.forEach(bag_, {*topic}, [&](const rosbag::MessageInstance& message, const ros::Time& received) {
    const auto ticks = message.instantiate<WheelTicks>();
    if (!ticks)
      throw InputError(path_ + ": " + *topic + " is " + message.getDataType() +
                       ", expected stereo_nav/WheelTicks");
    try {
      samples_.push_back(toWheelSample(*ticks, drive));
    } catch (const InputError& error) {
      throw InputError(path_ + ": " + error.what());
    }
    stamps.push_back({ticks->header.stamp, received});
  });
  clock_ = RecordedClock(stamps);
  clock_.straighten(samples_, [](odometry::WheelSample& sample) -> double& { return sample.time_s; });
  keepIncreasing(samples_, notes_);
  if (samples_.empty()) throw InputError(path_ + ": " + *topic + " holds no reading of the wheels");
  const double from_s = samples_.front().time_s + options.start_s;
  const double to_s = from_s + options.duration_s;
  const auto outside = [&](const auto& sample) { return sample.time_s < from_s || sample.time_s > to_s; };
  samples_.erase(std::remove_if(samples_.begin(), samples_.end(), outside), samples_.end());
  if (samples_.size() < 2)
    throw InputError(path_ +
                     ": less than two readings of the wheels between --start and --start + --duration");
}

void WheelRecording::addYaw() {
  const auto topic = find(topics::kImu);
  if (!topic) return;
  RecordedImu imu = readRecordedImu(bag_, order_, path_, *topic);
  clock_.straighten(imu.samples, [](ImuSample& sample) -> double& { return sample.time_s; });
  std::stable_sort(imu.samples.begin(), imu.samples.end(),
                   [](const ImuSample& a, const ImuSample& b) { return a.time_s < b.time_s; });
  imu_set_aside_ = imuStampProblem(imu.samples, samples_.front().time_s, samples_.back().time_s);
  const std::string frame = imu.frame.value_or("");
  Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();
  try {
    if (frame != frames::kBase)
      R_base_imu =
          toIsometry(transforms_.lookupTransform(frames::kBase, frame, ros::Time(0)).transform).linear();
  } catch (const tf2::TransformException&) {
    if (imu_set_aside_.empty()) imu_set_aside_ = missingImuFrame(frame);
  }
  if (!imu_set_aside_.empty() || imu.samples.empty()) return;
  uses_imu_ = true;
  odometry::ImuYaw yaw(R_base_imu);
  std::size_t next = 0;
  for (auto& sample : samples_) {
    while (next < imu.samples.size() && yaw.newest_s() < sample.time_s) yaw.add(imu.samples[next++]);
    sample.yaw_rad = yaw.at(sample.time_s);
  }
}

Trajectory WheelRecording::poses(const std::string& topic, bool required) const {
  const auto found = find(topic.substr(std::min(topic.find_first_not_of('/'), topic.size())));
  if (!found) {
    if (!required) return {};
    throw InputError(path_ + ": no topic " + topic + " with poses (and no such file); the bag holds " +
                     listed(topics_));
  }
  RecordedPoses recorded = readRecordedPoses(bag_, order_, path_, *found);
  clock_.straighten(recorded.trajectory, [](StampedPose& pose) -> double& { return pose.time_s; });
  if (recorded.body_frame.empty() || recorded.body_frame == frames::kBase) return recorded.trajectory;
  return ofOtherBody(recorded.trajectory, T_base(recorded.body_frame).inverse());
}

Eigen::Isometry3d WheelRecording::T_base(const std::string& frame) const {
  try {
    return toIsometry(
        transforms_.lookupTransform(frames::kBase, withoutSlash(frame), ros::Time(0)).transform);
  } catch (const tf2::TransformException&) {
    throw InputError(path_ + ": tf_static has no transform from " + frames::kBase + " to '" + frame +
                     "', whose poses are given; record /tf_static, too");
  }
}

}  // namespace stereo_nav::ros_io
