#pragma once

#include <limits>
#include <string>
#include <vector>

#include "odometry/laser/laser_scan.h"
#include "ros/recorded_robot.h"

namespace stereo_nav::ros_io {

/// The part of a recording that is read, and how.
struct LaserRecordingOptions {
  double start_s = 0.0;                                         ///< after the first scan
  double duration_s = std::numeric_limits<double>::infinity();  ///< counted from start_s
};

/// A bag with `scan` and, where recorded, `wheel/odom`, `imu/data`, `tf_static` and poses to compare with.
/// A topic of another name is taken where it is the only one of its type. Throws InputError for an unreadable
/// or damaged file, and where there is no sensor_msgs/LaserScan.
class LaserRecording {
 public:
  LaserRecording(const std::string& path, const LaserRecordingOptions& options);

  /// In order of time.
  const std::vector<odometry::LaserScan>& scans() const { return scans_; }
  const Eigen::Isometry3d& T_base_laser() const { return T_base_laser_; }
  /// base_link by the wheels; empty where there are none.
  const Trajectory& wheels() const { return wheels_; }
  const MountedImu& imu() const { return imu_; }
  /// The bag, with the poses that it holds.
  const RecordedRobot& robot() const { return robot_; }

 private:
  std::string topicOf(const char* name, const char* type) const;
  void readScans(const LaserRecordingOptions& options);
  void readWheels();
  void readImu();

  RecordedRobot robot_;
  std::vector<odometry::LaserScan> scans_;
  Eigen::Isometry3d T_base_laser_ = Eigen::Isometry3d::Identity();
  Trajectory wheels_;
  MountedImu imu_;
};

}  // namespace stereo_nav::ros_io
