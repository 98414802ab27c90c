#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <deque>
#include <future>
#include <memory>

#include "stereo_nav/ros_io/simulated_messages.h"

namespace stereo_nav::nodes {

/// Private parameters of the simulator.
struct SimulatorParams {
  int seed = 1;
  int threads = 1;
  double start_delay_s = 1.0;

  void describe(ParameterVisitor& visitor);
};

/// Plays a simulation at real time on the topics of stereo_capture and imu_bridge, plus the ground truth.
/// Pairs are rendered ahead of their time on `threads` threads; a pair that is not ready within two periods
/// of its time is dropped, counted and said.
class SimulatorNode {
 public:
  SimulatorNode(ros::NodeHandle& node, const sim::Simulation& simulation, const SimulatorParams& params);

  /// Returns when the path is driven or ROS shuts down.
  void run();

 private:
  void publishUntil(double time_s);
  void renderAhead();
  void publishPair(const ros_io::PairMessages& pair);
  double now_s() const { return (ros::Time::now() - start_).toSec(); }

  const sim::Simulation& simulation_;
  SimulatorParams params_;
  ros::Time start_;
  ros_io::SimulatedMessages messages_;
  image_transport::ImageTransport transport_;
  image_transport::Publisher left_image_, right_image_;
  ros::Publisher left_info_, right_info_, sync_, imu_, imu_quaternion_, ground_truth_, waypoint_, tf_static_;
  std::deque<std::future<ros_io::PairMessages>> rendering_;
  std::size_t next_to_render_ = 0;
  std::size_t next_imu_ = 0;
  std::size_t next_waypoint_ = 0;
  std::uint64_t pairs_late_ = 0;
};

}  // namespace stereo_nav::nodes
