#pragma once

#include "core/planar_motion.h"
#include "odometry/laser/laser_odometry.h"
#include "ros/laser_recording.h"

namespace stereo_nav::ros_io {

/// Hands wheels and gyroscope of a recording to the laser odometry, up to the end of each scan.
class LaserFeed {
 public:
  LaserFeed(const LaserRecording& recording, odometry::LaserOdometry& odometry)
      : recording_(recording), odometry_(odometry) {}

  void upTo(double time_s) {
    odometry::MotionInputs& inputs = odometry_.inputs();
    const Trajectory& wheels = recording_.wheels();
    while (wheel_ < wheels.size() && inputs.newestWheels_s() < time_s) {
      inputs.addWheels(wheels[wheel_].time_s, planarPart(wheels[wheel_].T_world_body));
      ++wheel_;
    }
    const MountedImu& imu = recording_.imu();
    while (imu_ < imu.samples.size() && inputs.newestImu_s() < time_s)
      inputs.addImu(imu.samples[imu_++], imu.R_base_imu);
  }

 private:
  const LaserRecording& recording_;
  odometry::LaserOdometry& odometry_;
  std::size_t wheel_ = 0;
  std::size_t imu_ = 0;
};

}  // namespace stereo_nav::ros_io
