#include "ros/fusion_messages.h"

#include <cmath>
#include <limits>

#include "core/local_tangent_plane.h"
#include "core/roll_pitch_yaw.h"
#include "ros/setup_checks.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::ros_io {
namespace {

using estimation::Measurement;
using estimation::SensorChannels;

/// Not a number where the quaternion is none: the filter leaves the attitude out and says so.
Eigen::Isometry3d toPose(const geometry_msgs::Point& p, const geometry_msgs::Quaternion& q) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << p.x, p.y, p.z;
  const Eigen::Quaterniond quaternion(q.w, q.x, q.y, q.z);
  const bool usable = std::abs(quaternion.norm() - 1.0) < 0.1;
  T.linear() = usable ? quaternion.normalized().toRotationMatrix()
                      : Eigen::Matrix3d(Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  return T;
}

template <int kSize, class Array>
Eigen::Matrix<double, kSize, kSize> toMatrix(const Array& values) {
  return Eigen::Map<const Eigen::Matrix<double, kSize, kSize, Eigen::RowMajor>>(values.data());
}

Vector6d toTwist(const geometry_msgs::Twist& twist) {
  Vector6d vector;
  vector << twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y, twist.angular.z;
  return vector;
}

Eigen::Vector3d toVector(const geometry_msgs::Vector3& v) {
  return {v.x, v.y, v.z};
}

/// Where both parts have the same covariance of three fields.
Matrix6d placed(const Eigen::Matrix3d& covariance, int first) {
  Matrix6d whole = Matrix6d::Zero();
  whole.block<3, 3>(first, first) = covariance;
  return whole;
}

/// Variances that stand for "unknown" or "not stated" must survive a rotation.
Eigen::Matrix3d turned(const Eigen::Matrix3d& R, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d variances = covariance.diagonal();
  if ((variances.array() - variances[0]).abs().maxCoeff() == 0.0 && covariance.isDiagonal(0.0))
    return covariance;
  return R * covariance * R.transpose();
}

}  // namespace

FusionMessages::FusionMessages(const estimation::FusionConfig& config, const estimation::FusionSetup& setup,
                               Mounting mounting)
    : config_(config), setup_(setup), mounting_(std::move(mounting)) {}

std::optional<Eigen::Isometry3d> FusionMessages::T_base(const std::string& frame_id) {
  const std::string frame = withoutSlash(frame_id);
  if (frame.empty() || frame == config_.params.base_link_frame) return Eigen::Isometry3d::Identity();
  const auto known = known_frames_.find(frame);
  if (known != known_frames_.end()) return known->second;
  const auto found = mounting_(frame);
  if (found) {
    known_frames_[frame] = *found;
    unknown_frames_.erase(frame);
  } else {
    ++unknown_frames_[frame];
  }
  return found;
}

void FusionMessages::addPose(std::size_t sensor, double time_s, const Eigen::Isometry3d& T_world_base,
                             const Matrix6d& covariance, const std::optional<Matrix6d>& twist_covariance,
                             std::vector<Measurement>& measurements) {
  const SensorChannels& channels = setup_.sensors[sensor];
  if (channels.pose < 0) return;
  Measurement measurement;
  measurement.channel = channels.pose;
  measurement.time_s = time_s;
  measurement.kind = setup_.channels[static_cast<std::size_t>(channels.pose)].kind;
  measurement.fields = channels.pose_fields;
  measurement.pose = T_world_base;
  measurement.covariance = covariance;
  measurement.twist_covariance = twist_covariance;
  if (config_.sensors[sensor].params.relative && T_world_base.matrix().allFinite()) {
    const auto first = first_pose_.emplace(sensor, T_world_base).first;
    measurement.pose = first->second.inverse() * T_world_base;
  }
  measurements.push_back(measurement);
}

void FusionMessages::addTwist(std::size_t sensor, double time_s, const std::string& frame,
                              const Vector6d& twist, const Matrix6d& covariance,
                              std::vector<Measurement>& measurements) {
  const SensorChannels& channels = setup_.sensors[sensor];
  if (channels.twist < 0) return;
  const auto T_base_body = T_base(frame);
  if (!T_base_body) return;
  Measurement measurement;
  measurement.channel = channels.twist;
  measurement.time_s = time_s;
  measurement.kind = Measurement::Kind::kTwist;
  measurement.fields = channels.twist_fields;
  measurement.value = twist;
  measurement.covariance = covariance;
  if (!T_base_body->isApprox(Eigen::Isometry3d::Identity())) {
    const Matrix6d carry = adjoint(*T_base_body);
    measurement.value = carry * twist;
    measurement.covariance.topLeftCorner<3, 3>() =
        turned(T_base_body->linear(), covariance.topLeftCorner<3, 3>());
    measurement.covariance.bottomRightCorner<3, 3>() =
        turned(T_base_body->linear(), covariance.bottomRightCorner<3, 3>());
  }
  measurements.push_back(measurement);
}

std::vector<Measurement> FusionMessages::convert(std::size_t sensor, const nav_msgs::Odometry& message) {
  std::vector<Measurement> measurements;
  const auto T_base_body = T_base(message.child_frame_id);
  if (!T_base_body) return measurements;
  const double time_s = message.header.stamp.toSec();
  const Eigen::Isometry3d T_world_base =
      toPose(message.pose.pose.position, message.pose.pose.orientation) * T_base_body->inverse();
  const auto twist_covariance = toMatrix<6>(message.twist.covariance);
  addPose(sensor, time_s, T_world_base, toMatrix<6>(message.pose.covariance), Matrix6d(twist_covariance),
          measurements);
  addTwist(sensor, time_s, message.child_frame_id, toTwist(message.twist.twist), twist_covariance,
           measurements);
  return measurements;
}

std::vector<Measurement> FusionMessages::convert(std::size_t sensor,
                                                 const geometry_msgs::PoseWithCovarianceStamped& message) {
  std::vector<Measurement> measurements;
  addPose(sensor, message.header.stamp.toSec(),
          toPose(message.pose.pose.position, message.pose.pose.orientation),
          toMatrix<6>(message.pose.covariance), std::nullopt, measurements);
  return measurements;
}

std::vector<Measurement> FusionMessages::convert(std::size_t sensor,
                                                 const geometry_msgs::TwistWithCovarianceStamped& message) {
  std::vector<Measurement> measurements;
  addTwist(sensor, message.header.stamp.toSec(), message.header.frame_id, toTwist(message.twist.twist),
           toMatrix<6>(message.twist.covariance), measurements);
  return measurements;
}

std::vector<Measurement> FusionMessages::convert(std::size_t sensor, const sensor_msgs::Imu& message) {
  std::vector<Measurement> measurements;
  const auto mounting = T_base(message.header.frame_id);
  if (!mounting) return measurements;
  const Eigen::Matrix3d R = mounting->linear();
  const double time_s = message.header.stamp.toSec();
  const SensorChannels& channels = setup_.sensors[sensor];
  if (channels.pose >= 0 && message.orientation_covariance[0] != -1.0) {
    Eigen::Isometry3d T = toPose(geometry_msgs::Point(), message.orientation);
    T.linear() = (T.linear() * R.transpose()).eval();
    addPose(sensor, time_s, T, placed(toMatrix<3>(message.orientation_covariance), 3), std::nullopt,
            measurements);
  }
  Measurement measurement;
  measurement.time_s = time_s;
  if (channels.twist >= 0 && message.angular_velocity_covariance[0] != -1.0) {
    measurement.channel = channels.twist;
    measurement.kind = Measurement::Kind::kRate;
    measurement.fields = channels.twist_fields;
    measurement.value.tail<3>() = R * toVector(message.angular_velocity);
    measurement.covariance = placed(turned(R, toMatrix<3>(message.angular_velocity_covariance)), 3);
    measurements.push_back(measurement);
  }
  if (channels.acceleration >= 0 && message.linear_acceleration_covariance[0] != -1.0) {
    measurement.channel = channels.acceleration;
    measurement.kind = Measurement::Kind::kAcceleration;
    measurement.fields = channels.acceleration_fields;
    measurement.value.head<3>() = R * toVector(message.linear_acceleration);
    measurement.covariance = placed(turned(R, toMatrix<3>(message.linear_acceleration_covariance)), 0);
    measurement.p_base_sensor = mounting->translation();
    measurements.push_back(measurement);
  }
  return measurements;
}

std::vector<Measurement> FusionMessages::convert(std::size_t sensor, const sensor_msgs::NavSatFix& message) {
  std::vector<Measurement> measurements;
  const auto T_base_antenna = T_base(message.header.frame_id);
  const Eigen::Vector3d fix(message.latitude, message.longitude, message.altitude);
  if (!T_base_antenna || message.status.status < sensor_msgs::NavSatStatus::STATUS_FIX || !fix.allFinite())
    return measurements;
  const Eigen::Vector3d first = first_fix_.emplace(sensor, fix).first->second;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = eastNorthUp_m(first, fix);
  addPose(sensor, message.header.stamp.toSec(), T, placed(toMatrix<3>(message.position_covariance), 0),
          std::nullopt, measurements);
  return measurements;
}

}  // namespace stereo_nav::ros_io
