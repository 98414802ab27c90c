#include "ros/wheel_recording.h"

#include <algorithm>

#include "odometry/wheel/imu_yaw.h"
#include "ros/bag_structure.h"
#include "ros/wheel_ticks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

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
    : robot_(path) {
  readBag(path, [&] {
    readTicks(drive, options);
    if (options.imu) addYaw();
  });
}

void WheelRecording::readTicks(const kinematics::DriveParams& drive, const WheelRecordingOptions& options) {
  const auto topic = robot_.find(topics::kWheelTicks);
  if (!topic) {
    throw InputError(robot_.path() + ": no topic " + topics::kWheelTicks + "; the bag holds " +
                     robot_.topicList() + ". Record what publishes the encoders");
  }
  std::vector<ReceivedStamp> stamps;
  robot_.orderBy(*topic);
  robot_.order().forEach(robot_.bag(), {*topic},
                         [&](const rosbag::MessageInstance& message, const ros::Time& received) {
                           const auto ticks = message.instantiate<WheelTicks>();
                           if (!ticks)
                             throw InputError(robot_.path() + ": " + *topic + " is " + message.getDataType() +
                                              ", expected stereo_nav/WheelTicks");
                           try {
                             samples_.push_back(toWheelSample(*ticks, drive));
                           } catch (const InputError& error) {
                             throw InputError(robot_.path() + ": " + error.what());
                           }
                           stamps.push_back({ticks->header.stamp, received});
                         });
  robot_.setClock(stamps);
  robot_.clock().straighten(samples_, [](odometry::WheelSample& sample) -> double& { return sample.time_s; });
  keepIncreasing(samples_, robot_.notes());
  if (samples_.empty()) throw InputError(robot_.path() + ": " + *topic + " holds no reading of the wheels");
  const double from_s = samples_.front().time_s + options.start_s;
  const double to_s = from_s + options.duration_s;
  const auto outside = [&](const auto& sample) { return sample.time_s < from_s || sample.time_s > to_s; };
  samples_.erase(std::remove_if(samples_.begin(), samples_.end(), outside), samples_.end());
  if (samples_.size() < 2)
    throw InputError(robot_.path() +
                     ": less than two readings of the wheels between --start and --start + --duration");
}

void WheelRecording::addYaw() {
  const auto topic = robot_.find(topics::kImu);
  if (!topic) return;
  const MountedImu imu = robot_.imu(*topic, samples_.front().time_s, samples_.back().time_s);
  imu_set_aside_ = imu.set_aside;
  if (imu.samples.empty()) return;
  uses_imu_ = true;
  odometry::ImuYaw yaw(imu.R_base_imu);
  std::size_t next = 0;
  for (auto& sample : samples_) {
    while (next < imu.samples.size() && yaw.newest_s() < sample.time_s) yaw.add(imu.samples[next++]);
    sample.yaw_rad = yaw.at(sample.time_s);
  }
}

}  // namespace stereo_nav::ros_io
