#include "nodes/base_bridge/base_bridge_node.h"

#include <algorithm>

#include "kinematics/drive_file.h"
#include "ros/parameter_server.h"
#include "sensors/serial/steady_clock.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kRepeat_s = 10.0;
constexpr double kPoll_s = 0.002;
/// Time that a service waits for the controller.
constexpr double kConfirmation_s = 1.0;

ros_io::BaseBridgeParams readNodeParams(const ros::NodeHandle& private_handle) {
  ros_io::BaseBridgeParams params;
  ros_io::readParameters(
      {ros_io::fileSource(private_handle, "config"), ros_io::rigSource(private_handle, rig_sections::kBase),
       ros_io::serverSource(private_handle, {"diagnostic_period"})},
      params);
  params.checkNames();
  return params;
}

kinematics::DriveParams readWheels(const ros::NodeHandle& private_handle) {
  const auto rig = private_handle.param<std::string>("rig", "");
  if (rig.empty())
    throw ParameterError(
        "~rig is not set; it is the path of the rig file, whose section `drive` describes the wheels");
  return kinematics::readDrive(RigFile::load(rig));
}

}  // namespace

BaseBridgeNode::BaseBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      params_(readNodeParams(private_handle_)),
      drive_(readWheels(private_handle_)),
      device_(params_.device, serial::PortFinder(params_.port, params_.by_id_directory)),
      publishers_(handle_, params_, drive_),
      updater_(handle_, private_handle_),
      control_(params_, drive_),
      problems_(kRepeat_s) {
  subscribe();
  stop_ = handle_.advertiseService("base/stop", &BaseBridgeNode::handleStop, this);
  release_ = handle_.advertiseService("base/release", &BaseBridgeNode::handleRelease, this);
  updater_.setHardwareID(params_.port);
  updater_.add("base", this, &BaseBridgeNode::fillStatus);
  watch_timer_ = handle_.createWallTimer(ros::WallDuration(0.1), &BaseBridgeNode::watch, this);
}

/// Queues of one: only the newest order counts. Its time is taken before the mutex, behind which it may wait.
void BaseBridgeNode::subscribe() {
  using Number = std_msgs::Float64;
  order_topics_ = {ros_io::topics::kCmdVel};
  const auto hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(
      handle_.subscribe(ros_io::topics::kCmdVel, 1, &BaseBridgeNode::handleVelocity, this, hints));
  for (std::size_t i = 0; i < params_.joints.size(); ++i) {
    const std::string topic = ros_io::topics::kJoint + params_.joints[i].name;
    order_topics_.push_back(topic);
    subscribers_.push_back(
        handle_.subscribe<Number>(topic, 1, [this, i, topic](const Number::ConstPtr& message) {
          const double now_s = serial::steadyNow_s();
          const std::lock_guard<std::mutex> lock(mutex_);
          handleOrder(topic, control_.setJoint(i, message->data, now_s));
        }));
  }
  for (std::size_t i = 0; i < params_.actuators.size(); ++i) {
    const std::string topic = ros_io::topics::kActuator + params_.actuators[i].name;
    order_topics_.push_back(topic);
    subscribers_.push_back(
        handle_.subscribe<Number>(topic, 1, [this, i, topic](const Number::ConstPtr& message) {
          const double now_s = serial::steadyNow_s();
          const std::lock_guard<std::mutex> lock(mutex_);
          handleOrder(topic, control_.setActuator(i, message->data, now_s));
        }));
  }
}

void BaseBridgeNode::run() {
  while (ros::ok()) {
    device_.poll(kPoll_s, [this](const base::BaseReading& reading) { handleReading(reading); });
    sendDue();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto command = control_.farewell()) device_.send(*command);
}

void BaseBridgeNode::sendDue() {
  const double now_s = serial::steadyNow_s();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    control_.tick(now_s);
  }
  if (now_s < next_command_s_ && !is_urgent_.exchange(false)) return;
  const double period_s = 1.0 / params_.command_rate_hz;
  // After a pause of this program the next one is a period away: commands are never sent in a burst.
  next_command_s_ = std::max(next_command_s_ + period_s, now_s + 0.5 * period_s);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto command = control_.step(now_s)) device_.send(*command);
}

void BaseBridgeNode::handleReading(const base::BaseReading& reading) {
  bool fits = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    control_.addTelemetry(reading.telemetry, reading.arrival_s);
    telemetry_ = reading.telemetry;
    fits = control_.fits(reading.telemetry);
  }
  if (fits) publishers_.publish(reading);
}

void BaseBridgeNode::handleVelocity(const geometry_msgs::Twist::ConstPtr& message) {
  const double now_s = serial::steadyNow_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  handleOrder(ros_io::topics::kCmdVel,
              control_.setVelocity({message->linear.x, message->linear.y, message->angular.z}, now_s));
}

/// The caller holds the mutex.
void BaseBridgeNode::handleOrder(const std::string& topic, const std::optional<std::string>& refusal) {
  if (refusal) {
    raise(topic, true, topic + " is refused: " + *refusal);
  } else {
    clear(topic);
  }
}

bool BaseBridgeNode::waitForController() const {
  const double end_s = serial::steadyNow_s() + kConfirmation_s;
  while (ros::ok() && serial::steadyNow_s() < end_s) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (control_.confirmed(serial::steadyNow_s())) return true;
    }
    ros::WallDuration(0.005).sleep();
  }
  return false;
}

bool BaseBridgeNode::handleStop(std_srvs::Trigger::Request& /*request*/,
                                std_srvs::Trigger::Response& response) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    control_.stop();
  }
  is_urgent_ = true;
  response.success = static_cast<unsigned char>(waitForController());
  response.message =
      response.success != 0
          ? "stopped, until base/release"
          : "the stop is latched here and sent again and again, but the controller has not confirmed "
            "it; its own watchdog stops it where the line is broken: " +
                device_.status().message;
  ROS_WARN_STREAM("base/stop: " << response.message);
  return true;
}

bool BaseBridgeNode::handleRelease(std_srvs::Trigger::Request& /*request*/,
                                   std_srvs::Trigger::Response& response) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    control_.release();
  }
  is_urgent_ = true;
  response.success = static_cast<unsigned char>(waitForController());
  response.message =
      response.success != 0
          ? "released: the next cmd_vel drives"
          : "the controller has not confirmed the release, which takes effect when the line is "
            "back: " +
                device_.status().message;
  ROS_INFO_STREAM("base/release: " << response.message);
  return true;
}

void BaseBridgeNode::watch(const ros::WallTimerEvent& /*event*/) {
  updater_.update();
  const base::BaseDeviceStatus device = device_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (device.state == serial::LinkState::kStreaming) {
    clear("line");
  } else if (device.state != serial::LinkState::kWaiting) {
    raise("line", true, params_.port + ": " + device.message);
  }
  if (!control_.obstacle(serial::steadyNow_s())) {
    for (const std::string& topic : order_topics_) clear(topic);
  }
  if (control_.stopped()) {
    raise("stop", false, "the base is stopped; the service base/release lets it drive again");
  } else {
    clear("stop");
  }
}

void BaseBridgeNode::raise(const std::string& key, bool is_error, const std::string& text) {
  if (!problems_.raise(key, is_error, text, serial::steadyNow_s())) return;
  if (is_error) {
    ROS_ERROR_STREAM(text);
  } else {
    ROS_WARN_STREAM(text);
  }
}

void BaseBridgeNode::clear(const std::string& key) {
  if (problems_.clear(key)) ROS_INFO_STREAM("over: " << key);
}

void BaseBridgeNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const base::BaseDeviceStatus device = device_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto& counters = device.counters;
  const double volts = 1e-3 * telemetry_.battery_mV;
  status.summary(device.state == serial::LinkState::kStreaming ? Level::OK
                 : device.state == serial::LinkState::kWaiting ? Level::WARN
                                                               : Level::ERROR,
                 device.message);
  for (const auto& problem : problems_.all()) {
    if (problem.first != "line")
      status.mergeSummary(problem.second.is_error ? Level::ERROR : Level::WARN, problem.second.text);
  }
  if (volts > 0.0 && volts < params_.battery_empty_V)
    status.mergeSummary(Level::WARN, "the battery is empty: charge it");
  if (10 * (counters.bad_crc + counters.impossible) > counters.delivered)
    status.mergeSummary(Level::WARN,
                        "more than a tenth of the frames are damaged: check cable, ground and baud rate");
  status.add("port", params_.port);
  status.add("wheels", control_.drives() ? "follow cmd_vel" : "stopped");
  status.add("rate (Hz)", device.rate_hz);
  status.add("arrival jitter (ms)", 1e3 * device.arrival_jitter_s);
  status.add("stamp jitter (ms)", 1e3 * device.stamp_jitter_s);
  status.add("frames", counters.delivered);
  status.add("bad frames", counters.bad_crc + counters.impossible);
  status.add("lost frames", counters.lost);
  status.add("late or repeated frames", counters.stale);
  status.add("commands sent", device.commands_sent);
  status.add("commands not sent (no line)", device.commands_unsent);
  status.add("commands damaged at the controller", telemetry_.bad_commands);
  status.add("commands lost before the controller", telemetry_.lost_commands);
  status.add("cmd_vel refused", control_.velocitiesRefused());
  status.add("orders to servos and actuators refused", control_.devicesRefused());
  status.add("stops because cmd_vel fell silent", control_.velocitiesTimedOut());
  status.add("pauses of this program", control_.pauses());
  status.addf("battery (V)", "%.2f", volts);
  status.add("connections", device.connections);
}

}  // namespace stereo_nav::nodes
