#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rotation_history.h"
#include "nodes/visual_odometry/visual_odometry_params.h"
#include "odometry/method/watched_odometry.h"
#include "ros/inbox.h"
#include "ros/judged_infos.h"
#include "stereo_nav/odometry/method/odometry_config.h"
#include "vision/camera_order.h"

namespace stereo_nav::nodes {

/// Returns the transform that takes coordinates of `source` into `target`, at `time` (0: the newest). Where
/// tf does not know it, also after a short wait, returns nothing and gives the reason in `error`.
using TransformLookup = std::function<std::optional<Eigen::Isometry3d>(
    const std::string& target, const std::string& source, const ros::Time& time, std::string& error)>;

/// Data besides the frames.
struct SensorSetup {
  sensor_msgs::CameraInfoConstPtr left_info;
  sensor_msgs::CameraInfoConstPtr right_info;
  std::string imu_frame;  ///< empty before the first IMU message
};

/// The result of one frame, to be published.
struct SessionOutput {
  bool processed = false;                     ///< false: there is no odometry of this frame; `errors` say why
  std::map<std::string, std::string> errors;  ///< by kind
  std::map<std::string, std::string> warnings;  ///< by kind; the odometry runs, but with a defect
  std::vector<std::string> notes;               ///< expected events
  std::vector<std::string> announcements;       ///< events that the user should know of: restarts, changes
  odometry::StereoFrame images;
  odometry::FrameResult result;
  estimation::BaseEstimate base;
};

/// The odometry of a node, from messages to the pose of the base. Waits until calibration and mounting are
/// known, refuses invalid input, and starts anew when the clock jumps back or the cameras change. Knows no
/// topics; not thread-safe.
class OdometrySession {
 public:
  OdometrySession(const VisualOdometryParams& params, const odometry::OdometryConfig& config,
                  TransformLookup lookup);

  /// `live` means that the stamps come from a running clock, not from a replay. It decides whether the pose
  /// is kept when they jump back: a corrected clock must not move the robot, but a bag that starts again
  /// begins at the origin.
  SessionOutput process(const ros_io::Inbox::Work& work, const SensorSetup& setup, bool live);

  /// Applies changes by dynamic_reconfigure to all later frames.
  void applyLive(const VisualOdometryParams& params);

  /// Resets everything but the IMU's mounting; the next frame is the origin. A camera on a servo may have
  /// turned: it is taken where it is now.
  void reset();
  /// Returns false while there is no odometry yet.
  bool setPose(const Eigen::Isometry3d& T_odom_base, const Matrix6d& covariance);

  std::uint64_t framesProcessed() const { return frames_processed_; }
  std::uint64_t framesLost() const { return frames_lost_; }

 private:
  bool prepare(const ros_io::FrameMessages& frame, const SensorSetup& setup, SessionOutput& output);
  bool prepareCameras(const ros_io::FrameMessages& frame, const SensorSetup& setup, SessionOutput& output);
  std::string cameraMotion(const ros::Time& stamp) const;
  bool prepareImu(const SensorSetup& setup, SessionOutput& output);
  void makeOdometry(SessionOutput& output);
  void startAgain(const Eigen::Isometry3d& T_odom_base, const Matrix6d& covariance);
  void restartAfterJump(const ros_io::FrameMessages& frame, bool live, SessionOutput& output);
  void level(double time_s, SessionOutput& output);
  bool readImages(const ros_io::FrameMessages& frame, SessionOutput& output) const;
  void checkCameraOrder(SessionOutput& output);
  void checkRightStamps(SessionOutput& output);
  void checkImu(SessionOutput& output);

  VisualOdometryParams params_;
  odometry::OdometryConfig config_;
  TransformLookup lookup_;

  // The setup for which the odometry was created; when it changes, a new odometry is created.
  sensor_msgs::CameraInfoConstPtr left_info_;
  sensor_msgs::CameraInfoConstPtr right_info_;
  std::string camera_frame_;
  std::string imu_frame_;  ///< empty while the IMU is not used
  ros_io::JudgedInfos judged_;
  Eigen::Isometry3d T_base_camera_ = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d R_base_imu_ = Eigen::Matrix3d::Identity();
  std::unique_ptr<odometry::WatchedOdometry> odometry_;  ///< null until the whole setup is known

  std::optional<estimation::BaseOdometry> base_;
  RotationHistory imu_history_;  ///< used for levelling
  bool begins_ = true;           ///< no frame since the start or since reset()
  std::string imu_problem_;      ///< why the odometry has set the IMU aside; empty: it has not
  std::optional<vision::CameraOrderCheck> camera_order_;
  double camera_order_checked_s_ = 0.0;
  std::uint64_t frames_processed_ = 0;
  std::uint64_t frames_lost_ = 0;
};

}  // namespace stereo_nav::nodes
