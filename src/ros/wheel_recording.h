#pragma once

#include <limits>
#include <string>
#include <vector>

#include "kinematics/drive_params.h"
#include "odometry/wheel/wheel_odometry.h"
#include "ros/recorded_robot.h"

namespace stereo_nav::ros_io {

/// The part of a recording that is read, and how.
struct WheelRecordingOptions {
  double start_s = 0.0;                                         ///< after the first reading
  double duration_s = std::numeric_limits<double>::infinity();  ///< counted from start_s
  bool imu = true;                                              ///< use imu/data where the bag has it
};

/// A bag with `wheel_ticks` and, where recorded, `imu/data`, `tf_static` and poses to compare with. Topics
/// may have a namespace. Throws InputError for an unreadable or damaged file, and where wheel_ticks is
/// missing or of another drive.
class WheelRecording {
 public:
  WheelRecording(const std::string& path, const kinematics::DriveParams& drive,
                 const WheelRecordingOptions& options);

  /// Readings in order of time, with the IMU's yaw where there is one.
  const std::vector<odometry::WheelSample>& samples() const { return samples_; }
  /// What had to be assumed, or was left out; one line each.
  const std::vector<std::string>& notes() const { return robot_.notes(); }
  /// Why the recorded IMU is not used; empty where it is, or there is none.
  const std::string& imuSetAside() const { return imu_set_aside_; }
  bool usesImu() const { return uses_imu_; }

  /// The bag, with the poses that it holds.
  const RecordedRobot& robot() const { return robot_; }

 private:
  void readTicks(const kinematics::DriveParams& drive, const WheelRecordingOptions& options);
  void addYaw();

  RecordedRobot robot_;
  std::vector<odometry::WheelSample> samples_;
  std::string imu_set_aside_;
  bool uses_imu_ = false;
};

}  // namespace stereo_nav::ros_io
