#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "odometry/method/watched_odometry.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {

/// The transform that the recording `bag` must hold. Throws InputError that says how to record it.
Eigen::Isometry3d requireTransform(const ros_io::Recording& recording, const std::string& bag,
                                   const char* target, const std::string& source);

/// Where the IMU sits, and why it is set aside where that cannot be known.
struct ImuMounting {
  Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();
  std::string problem;  ///< empty: it is used
};
/// `no_imu`: as if there were none.
ImuMounting imuMounting(const ros_io::Recording& recording, bool no_imu);

/// A recorded pair as the odometry gets it, without disparity map.
odometry::StereoFrame rectifiedFrame(const ros_io::StereoProcessing& processing, const ros_io::RawPair& pair);

/// Poses of base_link from a TUM file or a topic of the bag: `source`, else ground_truth/odom where there is
/// one; `frame`, else what the topic names, is the frame whose poses they are.
Trajectory groundTruthOfBase(const ros_io::Recording& recording, const std::string& bag,
                             const std::optional<std::string>& source,
                             const std::optional<std::string>& frame);

/// Hands the samples of a recording to an odometry, as far as the frames have come.
class ImuFeed {
 public:
  explicit ImuFeed(const ros_io::Recording& recording) : recording_(recording) {}
  /// All samples up to the frame's last exposure and the first one after it, so that its end can be
  /// interpolated.
  void feed(double frame_time_s, odometry::WatchedOdometry& odometry);

 private:
  const ros_io::Recording& recording_;
  std::size_t next_ = 0;
};

}  // namespace stereo_nav::tools
