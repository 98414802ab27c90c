#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "ros/recorded_robot.h"
#include "ros/rectified_view.h"

namespace stereo_nav::ros_io {

/// The part of a recording that is read, and how.
struct MonoRecordingOptions {
  double start_s = 0.0;                                         ///< after the first image
  double duration_s = std::numeric_limits<double>::infinity();  ///< counted from start_s
  std::optional<double> rolling_shutter_s;  ///< replaces the value of camera/sync; 0: global shutter
};

/// One image, rectified, CV_8UC1.
struct MonoImage {
  double time_s;
  cv::Mat rectified;
};

/// A bag with the images of one camera and its camera_info: the left one of a stereo rig
/// (`camera/left/image_raw`), `camera/image_raw`, or the only sensor_msgs/Image beside a camera_info; where
/// recorded, `imu/data`, `wheel/odom`, `tf_static` and ground truth. Throws InputError for an unreadable or
/// damaged file and for missing topics.
class MonoRecording {
 public:
  MonoRecording(const std::string& path, const MonoRecordingOptions& options);

  const RectifiedView& view() const { return *view_; }
  const Eigen::Isometry3d& T_base_camera() const { return T_base_camera_; }
  /// From the first row of an image to its last.
  double readout_s() const { return readout_s_; }
  /// Stamps of the images that forEachImage() hands out.
  const std::vector<double>& times_s() const { return times_s_; }
  const MountedImu& imu() const { return imu_; }
  /// base_link by the wheels; empty where there are none.
  const Trajectory& wheels() const { return wheels_; }
  const RecordedRobot& robot() const { return robot_; }

  /// Passes every image once, in order of time.
  void forEachImage(const std::function<void(const MonoImage&)>& handle) const;

 private:
  void findImages();
  void readInfo();
  void readStamps(const MonoRecordingOptions& options);
  void readReadout(const MonoRecordingOptions& options);
  void readMotion();

  RecordedRobot robot_;
  std::string image_topic_;
  std::string info_topic_;
  std::optional<RectifiedView> view_;
  Eigen::Isometry3d T_base_camera_ = Eigen::Isometry3d::Identity();
  double readout_s_ = 0.0;
  std::vector<double> times_s_;
  MountedImu imu_;
  Trajectory wheels_;
};

}  // namespace stereo_nav::ros_io
