#include "ros/simulated_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include "ros/judged_infos.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

SimulatedMessages::SimulatedMessages(const sim::Simulation& simulation, const ros::Time& start,
                                     const Eigen::Isometry3d& T_base_imu)
    : simulation_(simulation), start_(start), T_base_imu_(T_base_imu) {
  judgeInfos(toCameraInfo(simulation.calibration(sim::Side::kLeft), {}),
             toCameraInfo(simulation.calibration(sim::Side::kRight), {}));
}

PairMessages SimulatedMessages::pair(std::size_t index) const {
  const auto taken = [&](sim::Side side) {
    return TakenImage{simulation_.image(side, index), &simulation_.calibration(side),
                      1e-3 * simulation_.exposure(side, index).exposure_ms};
  };
  const sim::PairInstants& instants = simulation_.pairs()[index];
  PairMessages messages = toPairMessages(index, instants, taken(sim::Side::kLeft), taken(sim::Side::kRight),
                                         1e-3 * simulation_.scenario().sensor.rolling_shutter_ms, start_);
  messages.ground_truth = groundTruth(instants.left_s);
  messages.ground_truth.header.seq = messages.left.header.seq;
  return messages;
}

nav_msgs::Odometry SimulatedMessages::groundTruth(double time_s) const {
  return toOdometry(simulation_.trajectory().state(time_s), stamp(time_s));
}

sensor_msgs::Imu SimulatedMessages::imu(std::size_t index) const {
  const ImuSample& sample = simulation_.imu()[index];
  sensor_msgs::Imu message = toImu(sample, stamp(sample.time_s), T_base_imu_);
  message.header.seq = static_cast<std::uint32_t>(index);
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
  return toStaticTransforms(simulation_.scenario().rig.T_base_camera(),
                            simulation_.calibration(sim::Side::kRight).offsetX_m(), T_base_imu_, start_);
}

}  // namespace stereo_nav::ros_io
