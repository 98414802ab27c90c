#include "ros/sensor_messages.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>

#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {
namespace {

geometry_msgs::TransformStamped sensorTransform(const ros::Time& stamp, const char* child,
                                                const Eigen::Isometry3d& T) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T);
  message.header.stamp = stamp;
  message.header.frame_id = frames::kBase;
  message.child_frame_id = child;
  return message;
}

sensor_msgs::Image toImage(const cv::Mat& image, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  cv_bridge::CvImage(header, sensor_msgs::image_encodings::MONO8, image).toImageMsg(message);
  return message;
}

}  // namespace

PairMessages toPairMessages(std::size_t index, const sim::PairInstants& instants, const TakenImage& left,
                            const TakenImage& right, double readout_s, const ros::Time& start) {
  std_msgs::Header header;
  header.seq = static_cast<std::uint32_t>(index);
  header.stamp = start + ros::Duration(instants.left_s);
  header.frame_id = frames::kLeftOptical;

  PairMessages messages;
  messages.left = toImage(left.image, header);
  messages.right = toImage(right.image, header);
  messages.left_info = toCameraInfo(*left.calibration, header);
  messages.right_info = toCameraInfo(*right.calibration, header);
  messages.sync.header = header;
  messages.sync.left_stamp = header.stamp;
  messages.sync.right_stamp = start + ros::Duration(instants.right_s);
  messages.sync.skew_s = (messages.sync.right_stamp - messages.sync.left_stamp).toSec();
  messages.sync.left_sequence = instants.left_sequence;
  messages.sync.right_sequence = instants.right_sequence;
  messages.sync.pairs_dropped = instants.pairs_dropped;
  messages.sync.left_exposure_s = left.exposure_s;
  messages.sync.right_exposure_s = right.exposure_s;
  messages.sync.rolling_shutter_s = readout_s;
  messages.available_s = std::max(instants.left_s + 0.5 * (left.exposure_s + readout_s),
                                  instants.right_s + 0.5 * (right.exposure_s + readout_s));
  return messages;
}

sensor_msgs::CameraInfo toCameraInfo(const sim::CameraCalibration& calibration,
                                     const std_msgs::Header& header) {
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

nav_msgs::Odometry toOdometry(const sim::BaseState& state, const ros::Time& stamp) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stamp;
  odometry.header.frame_id = frames::kOdom;
  odometry.child_frame_id = frames::kBase;
  odometry.pose.pose = tf2::toMsg(state.T_world_base);
  tf2::toMsg(state.velocity_base, odometry.twist.twist.linear);
  tf2::toMsg(state.angular_velocity_base, odometry.twist.twist.angular);
  return odometry;
}

sensor_msgs::Imu toImu(const ImuSample& sample, const ros::Time& stamp, const Eigen::Isometry3d& T_base_imu) {
  sensor_msgs::Imu message;
  message.header.stamp = stamp;
  message.header.frame_id = frames::kImu;
  message.orientation.w = 1.0;
  if (sample.q_world_imu) {
    message.orientation = tf2::toMsg(*sample.q_world_imu * Eigen::Quaterniond(T_base_imu.linear()));
  } else {
    message.orientation_covariance[0] = -1.0;  // sensor_msgs/Imu: no such measurement
  }
  if (sample.angular_velocity) {
    tf2::toMsg(T_base_imu.linear().transpose() * *sample.angular_velocity, message.angular_velocity);
  } else {
    message.angular_velocity_covariance[0] = -1.0;
  }
  if (sample.linear_acceleration) {
    tf2::toMsg(T_base_imu.linear().transpose() * *sample.linear_acceleration, message.linear_acceleration);
  } else {
    message.linear_acceleration_covariance[0] = -1.0;
  }
  return message;
}

tf2_msgs::TFMessage toStaticTransforms(const Eigen::Isometry3d& T_base_left, double right_x_m,
                                       const Eigen::Isometry3d& T_base_imu, const ros::Time& stamp) {
  const Eigen::Translation3d right(right_x_m, 0.0, 0.0);
  tf2_msgs::TFMessage message;
  message.transforms = {sensorTransform(stamp, frames::kLeftOptical, T_base_left),
                        sensorTransform(stamp, "camera_right_optical", T_base_left * right),
                        sensorTransform(stamp, frames::kImu, T_base_imu)};
  return message;
}

}  // namespace stereo_nav::ros_io
