#include "ros/imu_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace stereo_nav::ros_io {

std::string imuStampProblem(const std::vector<ImuSample>& samples, double first_s, double last_s) {
  if (samples.empty()) return "";
  const double oldest_s = samples.front().time_s;
  const double newest_s = samples.back().time_s;
  if (newest_s >= first_s && oldest_s <= last_s) return "";
  if (newest_s == 0.0)
    return "the stamps of the IMU are 0 and do not cover the images; its driver has to set header.stamp";
  const std::string when = newest_s < first_s
                               ? fmt::format("end {:.1f} s before the first image", first_s - newest_s)
                               : fmt::format("begin {:.1f} s after the last image", oldest_s - last_s);
  return "the stamps of the IMU do not cover the images: they " + when +
         "; its driver has to stamp with the clock of the images (ROS time)";
}

std::string imuOffClock(double ahead_s) {
  return fmt::format(
      "the stamps of the IMU are {:.1f} s {} those of the images, so that it is not used; its driver has to stamp with the "
      "clock of the images (ROS time)",
      std::abs(ahead_s), ahead_s > 0.0 ? "after" : "before");
}

std::string missingImuFrame(const std::string& frame) {
  if (frame.empty())
    return "the messages of the IMU have an empty frame_id, so that nothing tells how it is mounted; set it in the driver";
  return "tf has no transform from base_link to the IMU's frame '" + frame +
         "', so that nothing tells how it is mounted; record /tf_static, too";
}

}  // namespace stereo_nav::ros_io
