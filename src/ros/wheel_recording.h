#pragma once

#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/drive_params.h"
#include "odometry/wheel/wheel_odometry.h"
#include "ros/recorded_poses.h"
#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/ros/recorded_clock.h"
#include "stereo_nav/ros/recorded_order.h"

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
  const std::vector<std::string>& notes() const { return notes_; }
  /// Why the recorded IMU is not used; empty where it is, or there is none.
  const std::string& imuSetAside() const { return imu_set_aside_; }
  bool usesImu() const { return uses_imu_; }

  /// Poses of base_link on `topic`; empty where the bag has no such topic and none was required.
  Trajectory poses(const std::string& topic, bool required) const;
  /// Pose of `frame` in base_link from the recorded static transforms. Throws InputError where there is none.
  Eigen::Isometry3d T_base(const std::string& frame) const;

 private:
  std::optional<std::string> find(const std::string& name) const;
  void readTicks(const kinematics::DriveParams& drive, const WheelRecordingOptions& options);
  void addYaw();

  std::string path_;
  mutable rosbag::Bag bag_;
  RecordedOrder order_;
  std::vector<std::string> topics_;
  tf2::BufferCore transforms_;
  RecordedClock clock_;
  std::vector<odometry::WheelSample> samples_;
  std::vector<std::string> notes_;
  std::string imu_set_aside_;
  bool uses_imu_ = false;
};

}  // namespace stereo_nav::ros_io
