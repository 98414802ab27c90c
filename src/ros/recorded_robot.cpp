#include "ros/recorded_robot.h"

#include <fmt/format.h>
#include <rosbag/view.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <set>

#include "ros/bag_structure.h"
#include "ros/imu_checks.h"
#include "ros/recorded_imu.h"
#include "ros/recorded_poses.h"
#include "ros/recorded_transforms.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

RecordedRobot::RecordedRobot(const std::string& path) : path_(path) {
  readBag(path, [&] {
    openBag(bag_, path);
    std::set<std::string> names;
    for (const rosbag::ConnectionInfo* connection : rosbag::View(bag_).getConnections())
      names.insert(connection->topic);
    topics_.assign(names.begin(), names.end());
    readStaticTransforms(bag_, transforms_, notes_);
  });
}

void RecordedRobot::orderBy(const std::string& topic) {
  order_ = RecordedOrder(bag_, topic);
}

std::optional<std::string> RecordedRobot::find(const std::string& name) const {
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

std::optional<std::string> RecordedRobot::onlyOfType(const std::string& type, const std::string& but) const {
  std::set<std::string> found;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag_).getConnections())
    if (connection->datatype == type && connection->topic != but) found.insert(connection->topic);
  return found.size() == 1 ? std::optional<std::string>(*found.begin()) : std::nullopt;
}

std::string RecordedRobot::topicList() const {
  return listed(topics_);
}

MountedImu RecordedRobot::imu(const std::string& topic, double from_s, double to_s) const {
  MountedImu result;
  RecordedImu recorded = readRecordedImu(bag_, order_, path_, topic);
  clock_.straighten(recorded.samples, [](ImuSample& sample) -> double& { return sample.time_s; });
  std::stable_sort(recorded.samples.begin(), recorded.samples.end(),
                   [](const ImuSample& a, const ImuSample& b) { return a.time_s < b.time_s; });
  result.set_aside = imuStampProblem(recorded.samples, from_s, to_s);
  const std::string frame = recorded.frame.value_or("");
  const auto T_base_imu = mounting(frame);
  if (T_base_imu) {
    result.R_base_imu = T_base_imu->linear();
  } else if (result.set_aside.empty()) {
    result.set_aside = missingImuFrame(frame);
  }
  if (result.set_aside.empty()) result.samples = std::move(recorded.samples);
  return result;
}

BasePoses RecordedRobot::poses(const std::string& topic, bool required,
                               const std::optional<std::string>& body_frame) const {
  const auto found = find(topic.substr(std::min(topic.find_first_not_of('/'), topic.size())));
  if (!found) {
    if (!required) return {};
    throw InputError(path_ + ": no topic " + topic + " with poses (and no such file); the bag holds " +
                     topicList());
  }
  RecordedPoses recorded = readRecordedPoses(bag_, order_, path_, *found);
  clock_.straighten(recorded.trajectory, [](StampedPose& pose) -> double& { return pose.time_s; });
  const std::string body = body_frame.value_or(recorded.body_frame);
  if (body.empty() || body == frames::kBase) return {recorded.trajectory, recorded.world_frame};
  return {ofOtherBody(recorded.trajectory, T_base(body).inverse()), recorded.world_frame};
}

std::optional<Eigen::Isometry3d> RecordedRobot::mounting(const std::string& frame) const {
  if (withoutSlash(frame) == frames::kBase) return Eigen::Isometry3d::Identity();
  try {
    return toIsometry(
        transforms_.lookupTransform(frames::kBase, withoutSlash(frame), ros::Time(0)).transform);
  } catch (const tf2::TransformException&) {
    // REP-120: the base on the floor, in whose plane both move.
    if (withoutSlash(frame) == frames::kFootprint) return Eigen::Isometry3d::Identity();
    return std::nullopt;
  }
}

Eigen::Isometry3d RecordedRobot::T_base(const std::string& frame) const {
  if (const auto T_base_frame = mounting(frame)) return *T_base_frame;
  throw InputError(path_ + ": tf_static has no transform from " + frames::kBase + " to '" + frame +
                   "', whose poses are given; record /tf_static, too");
}

}  // namespace stereo_nav::ros_io
