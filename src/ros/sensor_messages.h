#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <opencv2/core.hpp>

#include "sim/camera.h"
#include "sim/camera_clocks.h"
#include "sim/trajectory.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

// What simulated sensors measure, as messages: those of a scripted and of a driven robot.

/// The messages that stereo_capture publishes for one pair by default, and the true motion at its left image.
/// Images, infos and odometry carry the left image's exposure time; the true times are in `sync`.
struct PairMessages {
  sensor_msgs::Image left, right;
  sensor_msgs::CameraInfo left_info, right_info;
  StereoSync sync;
  nav_msgs::Odometry ground_truth;
  double available_s;  ///< when both images are complete, simulation time
};

/// One image with what it was taken by.
struct TakenImage {
  cv::Mat image;  ///< CV_8UC1
  const sim::CameraCalibration* calibration;
  double exposure_s;
};

/// All but the ground truth. `start` is the stamp of simulation time 0.
PairMessages toPairMessages(std::size_t index, const sim::PairInstants& instants, const TakenImage& left,
                            const TakenImage& right, double readout_s, const ros::Time& start);

/// What of a pair the robot publishes, on its topics, to an `out` as DrivenOutput has it.
template <class Out>
void writePair(const PairMessages& pair, const ros::Time& time, Out& out) {
  out.write(topics::kSync, time, pair.sync);
  out.write(topics::kLeftInfo, time, pair.left_info);
  out.write(topics::kRightInfo, time, pair.right_info);
  out.write(topics::kLeftImage, time, pair.left);
  out.write(topics::kRightImage, time, pair.right);
}

sensor_msgs::CameraInfo toCameraInfo(const sim::CameraCalibration& calibration,
                                     const std_msgs::Header& header);

/// Pose of `base_link` in `odom` and its velocities.
nav_msgs::Odometry toOdometry(const sim::BaseState& state, const ros::Time& stamp);

/// The simulation has the IMU in the base's origin with the base's axes; the message has the axes of
/// `T_base_imu`, but the acceleration remains that of the origin.
sensor_msgs::Imu toImu(const ImuSample& sample, const ros::Time& stamp, const Eigen::Isometry3d& T_base_imu);

/// Poses of the cameras and the IMU on `base_link`. The right optical frame is for display only: both images
/// carry the left one.
tf2_msgs::TFMessage toStaticTransforms(const Eigen::Isometry3d& T_base_left, double right_x_m,
                                       const Eigen::Isometry3d& T_base_imu, const ros::Time& stamp);

}  // namespace stereo_nav::ros_io
