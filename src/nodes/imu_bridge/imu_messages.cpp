#include "nodes/imu_bridge/imu_messages.h"

namespace stereo_nav::nodes {
namespace {

using Covariance = boost::array<double, 9>;

void setDiagonal(Covariance& covariance, double xx, double yy, double zz) {
  covariance = {xx, 0, 0, 0, yy, 0, 0, 0, zz};
}

/// Marks a quantity that the module does not deliver, as REP-145 and sensor_msgs/Imu prescribe.
void setAbsent(Covariance& covariance) {
  covariance.fill(0.0);
  covariance[0] = -1.0;
}

void fillVector(const std::optional<Eigen::Vector3d>& v, double stddev, geometry_msgs::Vector3& message,
                Covariance& covariance) {
  if (!v) return setAbsent(covariance);
  message.x = v->x();
  message.y = v->y();
  message.z = v->z();
  setDiagonal(covariance, stddev * stddev, stddev * stddev, stddev * stddev);
}

}  // namespace

geometry_msgs::Quaternion toMessage(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

sensor_msgs::Imu toMessage(const imu::ImuEstimate& estimate, const ros_io::ImuBridgeParams& params,
                           ros::Time stamp) {
  sensor_msgs::Imu message;
  message.header.stamp = stamp;
  message.header.frame_id = params.frame_id;
  if (estimate.q_world_imu) {
    message.orientation = toMessage(*estimate.q_world_imu);
    const double tilt = params.tilt_stddev_rad * params.tilt_stddev_rad;
    setDiagonal(message.orientation_covariance, tilt, tilt, params.yaw_stddev_rad * params.yaw_stddev_rad);
  } else {
    setAbsent(message.orientation_covariance);
  }
  fillVector(estimate.angular_velocity, params.angular_velocity_stddev_rad_s, message.angular_velocity,
             message.angular_velocity_covariance);
  fillVector(estimate.linear_acceleration, params.linear_acceleration_stddev_m_s2,
             message.linear_acceleration, message.linear_acceleration_covariance);
  return message;
}

}  // namespace stereo_nav::nodes
