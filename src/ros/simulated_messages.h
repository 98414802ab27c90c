#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Quaternion.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>

#include "ros/sensor_messages.h"
#include "sim/simulation.h"
#include "stereo_nav/WheelTicks.h"

namespace stereo_nav::ros_io {

/// The sensors of a simulation as messages. `start` is the stamp of simulation time 0. The simulation has the
/// IMU in the base's origin with the base's axes; its messages are converted to the axes of `T_base_imu`, but
/// the acceleration remains that of the origin. Const methods may be called from several threads.
/// `simulation` must outlive this object.
class SimulatedMessages {
 public:
  /// Throws InputError for a calibration that judgeInfos() refuses.
  SimulatedMessages(const sim::Simulation& simulation, const ros::Time& start,
                    const Eigen::Isometry3d& T_base_imu = Eigen::Isometry3d::Identity());

  ros::Time stamp(double time_s) const { return start_ + ros::Duration(time_s); }

  /// Renders both images.
  PairMessages pair(std::size_t index) const;
  sensor_msgs::Imu imu(std::size_t index) const;
  /// The thesis' `imu_quat`: attitude without a header, front-left-up.
  geometry_msgs::Quaternion imuQuaternion(std::size_t index) const;
  bool hasAttitude() const;
  /// The counters of the wheels.
  WheelTicks wheelTicks(std::size_t index) const;
  /// The robot passes way-point `index`: the stamp is the time of the passage, the point is the way-point in
  /// `odom`.
  geometry_msgs::PointStamped waypoint(std::size_t index) const;
  /// Poses of the cameras and the IMU on `base_link`. The right optical frame is for display only: both
  /// images carry the left one.
  tf2_msgs::TFMessage staticTransforms() const;

  /// Pose of `base_link` in `odom` and its velocities.
  nav_msgs::Odometry groundTruth(double time_s) const;

 private:
  const sim::Simulation& simulation_;
  ros::Time start_;
  Eigen::Isometry3d T_base_imu_;
};

}  // namespace stereo_nav::ros_io
