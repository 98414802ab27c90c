#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <deque>
#include <future>
#include <memory>
#include <vector>

#include "nodes/simulator/answers.h"
#include "nodes/simulator/simulator_params.h"
#include "nodes/simulator/topic_outlet.h"
#include "ros/driven_messages.h"

namespace stereo_nav::nodes {

/// A robot and its world, before they are brought to life.
struct DrivenSetup {
  sim::Scenario scenario;
  sim::StereoCalibrationPair calibration;
  ros_io::DrivenDevices devices;
  Eigen::Isometry3d T_base_imu = Eigen::Isometry3d::Identity();
};

/// A simulated robot that follows cmd_vel, on the topics of the bridges and of stereo_capture; services
/// simulator/reset and simulator/pause.
///
/// Live it keeps the time of ROS; pairs are rendered beside it on `threads` threads, and those that find all
/// of them busy are dropped and counted. Stepped it is the clock of ROS itself: time goes on by a step when
/// those who are named have answered. All callbacks run in the thread of run().
class DrivenSimulatorNode {
 public:
  /// Throws InputError and ParameterError.
  DrivenSimulatorNode(const ros::NodeHandle& handle, DrivenSetup setup, const SimulatorParams& params);

  /// Returns when ROS shuts down.
  void run();

 private:
  class Sink;

  void advertise();
  void restart(const ros::Time& start);
  void setStart(const ros::Time& start);
  void runLive();
  void keepUp();
  void runStepped();
  void step();
  void publishClock();
  void addShot(sim::StereoShot shot);
  void render();
  void publishRendered();

  void handleVelocity(const geometry_msgs::Twist::ConstPtr& message);
  bool handleReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool handlePause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  const DrivenSetup setup_;
  const SimulatorParams params_;
  TopicOutlet outlet_;
  std::unique_ptr<sim::DrivenSimulation> simulation_;
  std::shared_ptr<const ros_io::DrivenMessages> messages_;
  ros::Time start_;  ///< stamp of simulation time 0
  bool is_paused_ = false;
  std::deque<sim::StereoShot> waiting_;
  std::deque<std::future<ros_io::PairMessages>> rendering_;
  std::uint64_t published_ = 0, dropped_ = 0, dropped_reported_ = 0, fallen_behind_ = 0;
  std::vector<std::string> contacts_;
  ros::Subscriber
      velocity_;  ///< before the answers: a velocity is obeyed before it counts as the answer of its step
  Answers frame_answers_, step_answers_;
  diagnostic_updater::Updater updater_;
  ros::Publisher clock_, tf_static_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
