#include "ros/recorded_imu.h"

#include <geometry_msgs/Quaternion.h>
#include <sensor_msgs/Imu.h>

#include <sstream>

#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {
namespace {

void checkFinite(const ImuSample& sample, const std::string& topic) {
  if (sample.isFinite()) return;
  std::ostringstream message;
  message.precision(15);
  message
      << topic << " holds a NaN or an infinity at t = " << sample.time_s
      << " s; the IMU driver is at fault: repair the recording, or filter the topic out with `rosbag filter`";
  throw InputError(message.str());
}

}  // namespace

RecordedImu readRecordedImu(const rosbag::Bag& bag, const RecordedOrder& order, const std::string& path,
                            const std::string& topic) {
  RecordedImu recorded;
  order.forEach(bag, {topic}, [&](const rosbag::MessageInstance& message, const ros::Time& received) {
    ImuSample sample;
    if (const auto imu = message.instantiate<sensor_msgs::Imu>()) {
      sample = toImuSample(*imu);
      recorded.frame = withoutSlash(imu->header.frame_id);
    } else if (const auto q = message.instantiate<geometry_msgs::Quaternion>()) {
      // The thesis' topic has no header; the time of arrival is the only stamp.
      sample.time_s = received.toSec();
      sample.q_world_imu = Eigen::Quaterniond(q->w, q->x, q->y, q->z);
    } else {
      throw InputError(path + ": " + topic + " is " + message.getDataType() +
                       ", expected sensor_msgs/Imu or geometry_msgs/Quaternion");
    }
    checkFinite(sample, topic);
    recorded.samples.push_back(sample);
  });
  return recorded;
}

}  // namespace stereo_nav::ros_io
