#include <nav_msgs/Odometry.h>
#include <tf2_eigen/tf2_eigen.h>

#include "ros/bag_file.h"
#include "stereo_nav/WheelTicks.h"
#include "stereo_nav/ros/topics.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

ros::Time stampOf(double time_s) {
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(std::llround(time_s * 1e9)));
}

std_msgs::Header headerOf(double time_s, const char* frame_id, std::size_t number) {
  std_msgs::Header header;
  header.stamp = stampOf(time_s);
  header.frame_id = frame_id;
  header.seq = static_cast<std::uint32_t>(number);
  return header;
}

WheelTicks ticksOf(const WheelSequence& sequence, std::size_t index) {
  WheelTicks ticks;
  ticks.header = headerOf(sequence.readings[index].time_s, ros_io::frames::kBase, index);
  for (const auto& wheel : sequence.drive.wheels) ticks.names.push_back(wheel.name);
  ticks.pulses = sequence.readings[index].pulses;
  return ticks;
}

nav_msgs::Odometry truthOf(const WheelSequence& sequence, std::size_t index) {
  nav_msgs::Odometry odometry;
  odometry.header = headerOf(sequence.ground_truth[index].time_s, "world", index);
  odometry.child_frame_id = ros_io::frames::kBase;
  odometry.pose.pose = tf2::toMsg(sequence.ground_truth[index].T_world_body);
  return odometry;
}

}  // namespace

void writeWheelBag(const WheelSequence& sequence, const std::string& path) {
  ros_io::BagFile bag(path);
  for (std::size_t i = 0; i < sequence.readings.size(); ++i) {
    const WheelTicks ticks = ticksOf(sequence, i);
    bag.write(ros_io::topics::kWheelTicks, ticks.header.stamp, ticks);
    const nav_msgs::Odometry truth = truthOf(sequence, i);
    bag.write(ros_io::topics::kGroundTruth, truth.header.stamp, truth);
  }
  bag.commit();
}

}  // namespace stereo_nav::tools
