#include "tools/common/recorded_rig.h"

#include <filesystem>

#include "ros/imu_checks.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {

Eigen::Isometry3d requireTransform(const ros_io::Recording& recording, const std::string& bag,
                                   const char* target, const std::string& source) {
  const auto transform = recording.transform(target, source);
  if (transform) return *transform;
  throw InputError(
      bag + ": tf_static has no transform from " + target + " to '" + source +
      "'; record /tf_static too, with a publisher such as `rosrun tf2_ros static_transform_publisher x y z "
      "yaw pitch roll " +
      target + " " + source + "`");
}

odometry::StereoFrame rectifiedFrame(const ros_io::StereoProcessing& processing,
                                     const ros_io::RawPair& pair) {
  odometry::StereoFrame frame;
  frame.left_time_s = pair.left_time_s;
  frame.right_time_s = pair.right_time_s;
  frame.readout_s = pair.rolling_shutter_s;
  frame.left = processing.rectifyLeft(pair.left);
  frame.right = processing.rectifyRight(pair.right);
  return frame;
}

ImuMounting imuMounting(const ros_io::Recording& recording, bool no_imu) {
  ImuMounting mounting;
  if (recording.imu().empty()) return mounting;
  if (no_imu) mounting.problem = "--no-imu was asked for";
  // The thesis' header-less orientation is front-left-up: that of base_link.
  if (no_imu || !recording.imuFrame()) return mounting;
  mounting.problem =
      ros_io::imuStampProblem(recording.imu(), recording.firstLeft_s(), recording.lastLeft_s());
  if (!mounting.problem.empty()) return mounting;
  const std::string& frame = *recording.imuFrame();
  const auto T_base_imu = frame.empty() ? std::nullopt : recording.transform(ros_io::frames::kBase, frame);
  if (T_base_imu) {
    mounting.R_base_imu = T_base_imu->linear();
  } else {
    mounting.problem = ros_io::missingImuFrame(frame);
  }
  return mounting;
}

Trajectory groundTruthOfBase(const ros_io::Recording& recording, const std::string& bag,
                             const std::optional<std::string>& source,
                             const std::optional<std::string>& frame) {
  ros_io::Recording::GroundTruth truth;
  if (source && std::filesystem::exists(*source)) {
    truth.trajectory = readTum(*source);
  } else {
    truth = recording.groundTruth(source.value_or(ros_io::topics::kGroundTruth), source.has_value());
  }
  std::string body = frame.value_or(truth.body_frame);
  if (body.empty()) body = ros_io::frames::kBase;
  if (truth.trajectory.empty() || body == ros_io::frames::kBase) return truth.trajectory;
  const Eigen::Isometry3d T_base_body = requireTransform(recording, bag, ros_io::frames::kBase, body);
  return ofOtherBody(truth.trajectory, T_base_body.inverse());
}

void ImuFeed::feed(double frame_time_s, odometry::WatchedOdometry& odometry) {
  const auto& samples = recording_.imu();
  while (next_ < samples.size()) {
    const ImuSample& sample = samples[next_++];
    odometry.addImu(sample);
    if (sample.time_s >= frame_time_s) break;
  }
}

}  // namespace stereo_nav::tools
