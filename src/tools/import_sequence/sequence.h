#pragma once

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/import_sequence/frame_reader.h"

namespace stereo_nav::tools {

struct CameraTrack {
  std::vector<ros::Time> stamps;  ///< of every frame, increasing
  std::unique_ptr<FrameReader> frames;
  sensor_msgs::CameraInfo info;  ///< without header
};

struct ImuReading {
  ros::Time stamp;
  Eigen::Vector3d angular_velocity;     ///< rad/s
  Eigen::Vector3d linear_acceleration;  ///< m/s^2
};

struct ImuTrack {
  std::vector<ImuReading> readings;
  double angular_velocity_variance = 0.0;     ///< (rad/s)^2, 0: unknown
  double linear_acceleration_variance = 0.0;  ///< (m/s^2)^2, 0: unknown
};

struct CameraPose {
  ros::Time stamp;
  Eigen::Isometry3d T_world_camera;
};

/// A recording in any of the layouts. "camera" is the left optical frame as the rectified images see it (x
/// right, y down, z forward): the frame of every disparity and point downstream.
struct Sequence {
  CameraTrack left;
  CameraTrack right;
  std::optional<Eigen::Isometry3d> T_body_camera;  ///< of the body that carries the IMU; absent: no such body
  ImuTrack imu;                                    ///< in the axes of the body; may be empty
  std::vector<CameraPose> ground_truth;            ///< may be empty
  std::vector<std::string> notes;                  ///< what had to be assumed, one line each
};

/// Layouts without a date count from here. Not from zero: to ROS that is "no time yet", and an instant before
/// it (as in `now - 10 s`) does not exist.
constexpr double kStartTime_s = 1000.0;

/// EuRoC/ASL: `DIR/cam0`, `cam1` with `data.csv`, `data/` and `sensor.yaml`, and if they exist `imu0` and
/// `state_groundtruth_estimate0` (all possibly below `mav0/`). Images stay raw; the camera_infos rectify with
/// cv::stereoRectify (zero disparity at infinity, alpha 0). Body = IMU; the world is the layout's, z up.
/// Without `with_imu`, imu0 is not read.
Sequence readEuroc(const std::string& folder, bool with_imu = true);

/// KITTI odometry: `DIR/image_0`, `image_1` (rectified), `calib.txt` (P0, P1), `times.txt`, and if it exists
/// `poses.txt` (left camera in its first pose). Times count from kStartTime_s.
Sequence readKitti(const std::string& folder);

/// KITTI raw: a drive `YYYY_MM_DD/YYYY_MM_DD_drive_NNNN_sync` (rectified) or `..._extract` (raw) with
/// `image_00`, `image_01` (else `image_02`, `image_03`) and, if it exists, `oxts`; the calib_*.txt lie beside
/// the drive. Each camera keeps its stamps. Body = the inertial unit; the world of its poses has x east, z
/// up. Without `with_imu`, its rates are left out.
Sequence readKittiRaw(const std::string& folder, bool with_imu = true);

/// Rectified pairs in `DIR/left` and `DIR/right`, or in two videos whose names end in L and R or in left and
/// right; `calib.txt` with lines `fx`, `fy`, `cx`, `cy` (px), `baseline` (m) and, if need be, `fps`. Frame i
/// is taken at kStartTime_s + i / fps; without that line a video's own rate counts, and 10 Hz for folders
/// (other sources of stamps: image_stamps.h). Pairs that are not rectified have another calibration
/// (raw_pair.h).
Sequence readImages(const std::string& folder);

}  // namespace stereo_nav::tools
