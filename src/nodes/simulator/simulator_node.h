#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <atomic>
#include <deque>
#include <future>
#include <memory>
#include <string>

#include "nodes/simulator/simulator_params.h"
#include "ros/simulated_messages.h"

namespace stereo_nav::nodes {

/// Plays a simulation in real time on the topics of stereo_capture and imu_bridge, and publishes the ground
/// truth. Pairs are rendered ahead of their time on `threads` threads. A pair that is not ready within two
/// periods of its time is dropped, counted and reported.
class SimulatorNode {
 public:
  SimulatorNode(ros::NodeHandle& node, const sim::Simulation& simulation, const SimulatorParams& params,
                const Eigen::Isometry3d& T_base_imu);

  /// Returns at the end of the path or when ROS shuts down.
  void run();

 private:
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void publishUntil(double time_s);
  void renderAhead();
  void countLate();
  double lateTolerance_s() const { return 2.0 / simulation_.scenario().timing.rate_hz; }
  void publishPair(const ros_io::PairMessages& pair);
  double now_s() const { return (ros::Time::now() - start_).toSec(); }

  const sim::Simulation& simulation_;
  SimulatorParams params_;
  ros::Time start_;
  ros_io::SimulatedMessages messages_;
  image_transport::ImageTransport transport_;
  image_transport::Publisher left_image_, right_image_;
  ros::Publisher left_info_, right_info_, sync_, imu_, imu_quaternion_, ground_truth_, waypoint_, tf_static_,
      wheel_ticks_;
  std::atomic<double> rendering_s_{0.0};  ///< how long the last pair took
  std::deque<std::future<ros_io::PairMessages>> rendering_;
  std::size_t next_to_render_ = 0;
  std::size_t next_imu_ = 0;
  std::size_t next_ticks_ = 0;
  std::size_t next_waypoint_ = 0;
  std::atomic<std::uint64_t> pairs_published_{0}, pairs_late_{0};
  std::uint64_t pairs_late_reported_ = 0;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
