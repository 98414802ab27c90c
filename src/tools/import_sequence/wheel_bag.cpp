#include "ros/bag_file.h"
#include "stereo_nav/WheelTicks.h"
#include "stereo_nav/ros/topics.h"
#include "tools/import_sequence/bag_header.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

WheelTicks ticksOf(const WheelSequence& sequence, std::size_t index) {
  WheelTicks ticks;
  ticks.header = headerOf(sequence.readings[index].time_s, ros_io::frames::kBase, index);
  for (const auto& wheel : sequence.drive.wheels) ticks.names.push_back(wheel.name);
  ticks.pulses = sequence.readings[index].pulses;
  return ticks;
}

}  // namespace

void writeWheelBag(const WheelSequence& sequence, const std::string& path) {
  ros_io::BagFile bag(path);
  for (std::size_t i = 0; i < sequence.readings.size(); ++i) {
    const WheelTicks ticks = ticksOf(sequence, i);
    bag.write(ros_io::topics::kWheelTicks, ticks.header.stamp, ticks);
    const nav_msgs::Odometry truth = odometryOf(sequence.ground_truth[i], "world", i);
    bag.write(ros_io::topics::kGroundTruth, truth.header.stamp, truth);
  }
  bag.commit();
}

}  // namespace stereo_nav::tools
