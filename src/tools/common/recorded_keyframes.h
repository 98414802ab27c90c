#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "odometry/method/keyframe_maker.h"
#include "tools/common/recorded_rig.h"

namespace stereo_nav::tools {

/// The recording of a stereo rig from which keyframes are made, and how.
struct KeyframeRunOptions {
  std::string bag;
  std::string config;  ///< path of the odometry's parameter file
  ros_io::RecordingOptions part;
  std::optional<std::string> ground_truth, ground_truth_frame;  ///< as groundTruthOfBase() has them
  bool no_imu = false;
};

/// A frame of the run, and what it became.
struct RecordedFrame {
  const odometry::StereoFrame& frame;
  const odometry::FrameResult& result;
  std::optional<vision::Keyframe> keyframe;  ///< if the frame became one
  std::optional<Eigen::Isometry3d>
      T_world_camera;  ///< true pose of the left optical frame, where it is known
  double describe_ms;  ///< processor time that making the keyframe took
};

/// Runs the odometry of the images over a recording and makes the keyframes that the node would publish.
class KeyframeRun {
 public:
  /// Throws InputError, ParameterError.
  explicit KeyframeRun(const KeyframeRunOptions& options);

  const vision::StereoCalibration& calibration() const { return processing_.calibration(); }
  const Eigen::Isometry3d& T_base_camera() const { return T_base_camera_; }
  const Trajectory& groundTruth() const { return truth_; }  ///< of base_link; may be empty
  /// What had to be assumed or was left out, one line each; complete after the run.
  const std::vector<std::string>& notes() const { return notes_; }

  void forEachFrame(const std::function<void(const RecordedFrame&)>& handle,
                    const std::function<void(std::size_t done, std::size_t all)>& progress);

 private:
  ros_io::Recording recording_;
  ros_io::StereoProcessing processing_;
  Eigen::Isometry3d T_base_camera_;
  ImuMounting imu_;
  Trajectory truth_;
  odometry::WatchedOdometry odometry_;
  std::vector<std::string> notes_;
};

}  // namespace stereo_nav::tools
