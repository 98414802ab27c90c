#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/bag_file.h"
#include "stereo_nav/ros/topics.h"
#include "tools/import_sequence/bag_header.h"
#include "tools/import_sequence/laser_sequence.h"

namespace stereo_nav::tools {
namespace {

namespace topics = ros_io::topics;
namespace frames = ros_io::frames;

sensor_msgs::LaserScan scanOf(const LaserSequence& sequence, std::size_t index) {
  sensor_msgs::LaserScan scan;
  scan.header = headerOf(sequence.scans[index].time_s, frames::kLaser, index);
  const auto last = static_cast<double>(sequence.scans[index].ranges_m.size() - 1);
  scan.angle_min = static_cast<float>(sequence.angle_min_rad);
  scan.angle_max = static_cast<float>(sequence.angle_min_rad + last * sequence.angle_increment_rad);
  scan.angle_increment = static_cast<float>(sequence.angle_increment_rad);
  scan.range_min = static_cast<float>(sequence.range_min_m);
  scan.range_max = static_cast<float>(sequence.range_max_m);
  scan.ranges = sequence.scans[index].ranges_m;
  return scan;
}

/// The laser sits at the robot's origin.
tf2_msgs::TFMessage mounting(double time_s) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  message.transforms[0].header = headerOf(time_s, frames::kBase, 0);
  message.transforms[0].child_frame_id = frames::kLaser;
  message.transforms[0].transform.rotation.w = 1.0;
  return message;
}

}  // namespace

void writeLaserBag(const LaserSequence& sequence, const std::string& path) {
  ros_io::BagFile bag(path);
  const tf2_msgs::TFMessage tf = mounting(sequence.scans.front().time_s);
  bag.writeLatched(topics::kTfStatic, tf.transforms[0].header.stamp, tf);
  for (std::size_t i = 0; i < sequence.wheels.size(); ++i) {
    const nav_msgs::Odometry odometry = odometryOf(sequence.wheels[i], frames::kOdom, i);
    bag.write(topics::kWheelOdometry, odometry.header.stamp, odometry);
  }
  for (std::size_t i = 0; i < sequence.scans.size(); ++i) {
    const sensor_msgs::LaserScan scan = scanOf(sequence, i);
    bag.write(topics::kScan, scan.header.stamp, scan);
    const nav_msgs::Odometry truth = odometryOf(sequence.reference[i], frames::kCorrectedMap, i);
    bag.write(topics::kGroundTruth, truth.header.stamp, truth);
  }
  bag.commit();
}

}  // namespace stereo_nav::tools
