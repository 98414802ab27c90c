#pragma once

#include <rosbag/bag.h>

#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/ros/recorded_order.h"

namespace stereo_nav::ros_io {

/// The samples of an IMU in the order of recording.
struct RecordedImu {
  std::vector<ImuSample> samples;
  std::optional<std::string> frame;  ///< absent where messages have no header (the thesis' imu_quat)
};

/// Reads sensor_msgs/Imu or geometry_msgs/Quaternion. Throws InputError, which begins with `path`, for other
/// types and for samples that are not finite.
RecordedImu readRecordedImu(const rosbag::Bag& bag, const RecordedOrder& order, const std::string& path,
                            const std::string& topic);

}  // namespace stereo_nav::ros_io
