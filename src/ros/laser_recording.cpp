#include "ros/laser_recording.h"

#include <fmt/format.h>
#include <sensor_msgs/LaserScan.h>

#include <algorithm>

#include "ros/bag_structure.h"
#include "ros/laser_scan_message.h"
#include "ros/recorded_poses.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

/// In order of time, each stamp once; returns how many are left out.
template <class Item>
std::size_t keepIncreasingTimes(std::vector<Item>& items) {
  const std::size_t all = items.size();
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.time_s < b.time_s; });
  items.erase(std::unique(items.begin(), items.end(),
                          [](const Item& a, const Item& b) { return a.time_s == b.time_s; }),
              items.end());
  return all - items.size();
}

}  // namespace

LaserRecording::LaserRecording(const std::string& path, const LaserRecordingOptions& options) : robot_(path) {
  readBag(path, [&] {
    readScans(options);
    readWheels();
    readImu();
  });
}

/// Empty where there is none.
std::string LaserRecording::topicOf(const char* name, const char* type) const {
  if (const auto found = robot_.find(name)) return *found;
  return robot_.onlyOfType(type, robot_.find(topics::kGroundTruth).value_or("")).value_or("");
}

void LaserRecording::readScans(const LaserRecordingOptions& options) {
  const std::string topic = topicOf(topics::kScan, "sensor_msgs/LaserScan");
  if (topic.empty()) {
    throw InputError(robot_.path() + ": no topic " + topics::kScan + "; the bag holds " + robot_.topicList() +
                     ". Record what publishes the laser's scans");
  }
  std::vector<ReceivedStamp> stamps;
  std::string frame;
  robot_.orderBy(topic);
  robot_.order().forEach(
      robot_.bag(), {topic}, [&](const rosbag::MessageInstance& message, const ros::Time& received) {
        const auto scan = message.instantiate<sensor_msgs::LaserScan>();
        if (!scan)
          throw InputError(
              robot_.path() + ": " + topic + " is " + message.getDataType() +
              ", expected sensor_msgs/LaserScan; of a laser with several echoes take one (laser_proc)");
        scans_.push_back(toLaserScan(*scan));
        stamps.push_back({scan->header.stamp, received});
        frame = withoutSlash(scan->header.frame_id);
      });
  robot_.setClock(stamps);
  robot_.clock().straighten(scans_, [](odometry::LaserScan& scan) -> double& { return scan.time_s; });
  if (const std::size_t left_out = keepIncreasingTimes(scans_))
    robot_.notes().push_back(fmt::format(
        "{} scans repeat a stamp and are left out; does their driver stamp each once?", left_out));
  const double from_s = scans_.empty() ? 0.0 : scans_.front().time_s + options.start_s;
  const double to_s = from_s + options.duration_s;
  const auto outside = [&](const auto& scan) { return scan.time_s < from_s || scan.time_s > to_s; };
  scans_.erase(std::remove_if(scans_.begin(), scans_.end(), outside), scans_.end());
  if (scans_.size() < 2)
    throw InputError(robot_.path() + ": less than two scans between --start and --start + --duration");
  if (const auto T_base_laser = robot_.mounting(frame)) {
    T_base_laser_ = *T_base_laser;
  } else {
    robot_.notes().push_back(
        "tf_static has no transform from base_link to '" + frame +
        "': the laser is taken to be at the base, with its axes; record /tf_static, too");
  }
}

void LaserRecording::readWheels() {
  const std::string topic = topicOf(topics::kWheelOdometry, "nav_msgs/Odometry");
  if (topic.empty()) return;
  RecordedPoses recorded = readRecordedPoses(robot_.bag(), robot_.order(), robot_.path(), topic);
  robot_.clock().straighten(recorded.trajectory, [](StampedPose& pose) -> double& { return pose.time_s; });
  keepIncreasingTimes(recorded.trajectory);
  wheels_ = std::move(recorded.trajectory);
  if (recorded.body_frame.empty() || recorded.body_frame == frames::kBase) return;
  if (const auto T_base_body = robot_.mounting(recorded.body_frame)) {
    wheels_ = ofOtherBody(wheels_, T_base_body->inverse());
  } else {
    robot_.notes().push_back("the poses of " + topic + " are of '" + recorded.body_frame +
                             "', which is taken for base_link");
  }
}

void LaserRecording::readImu() {
  const std::string topic = topicOf(topics::kImu, "sensor_msgs/Imu");
  if (topic.empty()) return;
  imu_ = robot_.imu(topic, scans_.front().time_s, scans_.back().time_s);
  if (!imu_.set_aside.empty()) robot_.notes().push_back("the IMU is set aside: " + imu_.set_aside);
}

}  // namespace stereo_nav::ros_io
