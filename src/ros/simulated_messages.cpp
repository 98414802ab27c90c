#include "ros/simulated_messages.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <limits>

#include "ros/judged_infos.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

geometry_msgs::Vector3 toMessage(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

geometry_msgs::TransformStamped transform(const ros::Time& stamp, const char* child,
                                          const Eigen::Isometry3d& T) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T);
  message.header.stamp = stamp;
  message.header.frame_id = frames::kBase;
  message.child_frame_id = child;
  return message;
}

}  // namespace

SimulatedMessages::SimulatedMessages(const sim::Simulation& simulation, const ros::Time& start,
                                     const Eigen::Isometry3d& T_base_imu)
    : simulation_(simulation), start_(start), T_base_imu_(T_base_imu) {
  judgeInfos(info(sim::Side::kLeft, {}), info(sim::Side::kRight, {}));
}

sensor_msgs::CameraInfo SimulatedMessages::info(sim::Side side, const std_msgs::Header& header) const {
  const sim::CameraCalibration& calibration = simulation_.calibration(side);
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(calibration.width);
  info.height = static_cast<std::uint32_t>(calibration.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(calibration.D.begin(), calibration.D.end());
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(info.K.data()) = calibration.K;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(info.R.data()) = calibration.R;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(info.P.data()) = calibration.P;
  return info;
}

sensor_msgs::Image SimulatedMessages::image(sim::Side side, std::size_t pair,
                                            const std_msgs::Header& header) const {
  sensor_msgs::Image message;
  cv_bridge::CvImage(header, sensor_msgs::image_encodings::MONO8, simulation_.image(side, pair))
      .toImageMsg(message);
  return message;
}

PairMessages SimulatedMessages::pair(std::size_t index) const {
  const sim::PairInstants& instants = simulation_.pairs()[index];
  const double left_exposure_s = 1e-3 * simulation_.exposure(sim::Side::kLeft, index).exposure_ms;
  const double right_exposure_s = 1e-3 * simulation_.exposure(sim::Side::kRight, index).exposure_ms;
  const double readout_s = 1e-3 * simulation_.scenario().sensor.rolling_shutter_ms;
  std_msgs::Header header;
  header.seq = static_cast<std::uint32_t>(index);
  header.stamp = stamp(instants.left_s);
  header.frame_id = frames::kLeftOptical;

  PairMessages messages;
  messages.left = image(sim::Side::kLeft, index, header);
  messages.right = image(sim::Side::kRight, index, header);
  messages.left_info = info(sim::Side::kLeft, header);
  messages.right_info = info(sim::Side::kRight, header);
  messages.sync.header = header;
  messages.sync.left_stamp = header.stamp;
  messages.sync.right_stamp = stamp(instants.right_s);
  messages.sync.skew_s = (messages.sync.right_stamp - messages.sync.left_stamp).toSec();
  messages.sync.left_sequence = instants.left_sequence;
  messages.sync.right_sequence = instants.right_sequence;
  messages.sync.pairs_dropped = instants.pairs_dropped;
  messages.sync.left_exposure_s = left_exposure_s;
  messages.sync.right_exposure_s = right_exposure_s;
  messages.sync.rolling_shutter_s = readout_s;
  messages.ground_truth = groundTruth(instants.left_s);
  messages.ground_truth.header.seq = header.seq;
  messages.available_s = std::max(instants.left_s + 0.5 * (left_exposure_s + readout_s),
                                  instants.right_s + 0.5 * (right_exposure_s + readout_s));
  return messages;
}

nav_msgs::Odometry SimulatedMessages::groundTruth(double time_s) const {
  const sim::BaseState state = simulation_.trajectory().state(time_s);
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stamp(time_s);
  odometry.header.frame_id = frames::kOdom;
  odometry.child_frame_id = frames::kBase;
  odometry.pose.pose = tf2::toMsg(state.T_world_base);
  odometry.twist.twist.linear = toMessage(state.velocity_base);
  odometry.twist.twist.angular = toMessage(state.angular_velocity_base);
  return odometry;
}

sensor_msgs::Imu SimulatedMessages::imu(std::size_t index) const {
  const ImuSample& sample = simulation_.imu()[index];
  sensor_msgs::Imu message;
  message.header.seq = static_cast<std::uint32_t>(index);
  message.header.stamp = stamp(sample.time_s);
  message.header.frame_id = frames::kImu;
  message.orientation.w = 1.0;
  if (sample.q_world_imu) {
    message.orientation = tf2::toMsg(*sample.q_world_imu * Eigen::Quaterniond(T_base_imu_.linear()));
  } else {
    message.orientation_covariance[0] = -1.0;  // sensor_msgs/Imu: no such measurement
  }
  if (sample.angular_velocity) {
    message.angular_velocity = toMessage(T_base_imu_.linear().transpose() * *sample.angular_velocity);
  } else {
    message.angular_velocity_covariance[0] = -1.0;
  }
  if (sample.linear_acceleration) {
    message.linear_acceleration = toMessage(T_base_imu_.linear().transpose() * *sample.linear_acceleration);
  } else {
    message.linear_acceleration_covariance[0] = -1.0;
  }
  return message;
}

WheelTicks SimulatedMessages::wheelTicks(std::size_t index) const {
  const sim::SimulatedTicks& ticks = simulation_.wheels()[index];
  WheelTicks message;
  message.header.seq = static_cast<std::uint32_t>(index);
  message.header.stamp = stamp(ticks.time_s);
  message.header.frame_id = frames::kBase;
  for (const auto& wheel : simulation_.trueWheels().wheels) message.names.push_back(wheel.name);
  message.pulses = ticks.pulses;
  message.steering_rad = ticks.steering_rad;
  return message;
}

bool SimulatedMessages::hasAttitude() const {
  return !simulation_.imu().empty() && simulation_.imu().front().q_world_imu.has_value();
}

geometry_msgs::Quaternion SimulatedMessages::imuQuaternion(std::size_t index) const {
  return tf2::toMsg(simulation_.imu()[index].q_world_imu.value());
}

geometry_msgs::PointStamped SimulatedMessages::waypoint(std::size_t index) const {
  const sim::WaypointPassing& passing = simulation_.trajectory().waypoints()[index];
  geometry_msgs::PointStamped message;
  message.header.seq = static_cast<std::uint32_t>(index);
  message.header.stamp = stamp(passing.time_s);
  message.header.frame_id = frames::kOdom;
  message.point.x = passing.position.x();
  message.point.y = passing.position.y();
  return message;
}

tf2_msgs::TFMessage SimulatedMessages::staticTransforms() const {
  const Eigen::Isometry3d T_base_left = simulation_.scenario().rig.T_base_camera();
  const Eigen::Translation3d right(simulation_.calibration(sim::Side::kRight).offsetX_m(), 0.0, 0.0);
  tf2_msgs::TFMessage message;
  message.transforms = {transform(start_, frames::kLeftOptical, T_base_left),
                        transform(start_, "camera_right_optical", T_base_left * right),
                        transform(start_, frames::kImu, T_base_imu_)};
  return message;
}

}  // namespace stereo_nav::ros_io
