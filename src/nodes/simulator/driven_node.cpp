#include "nodes/simulator/driven_node.h"

#include <fmt/format.h>
#include <rosgraph_msgs/Clock.h>

#include <chrono>
#include <utility>

#include "ros/driven_output.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::nodes {
namespace {

namespace topics = ros_io::topics;

constexpr double kPoll_s = 0.002;
/// The simulation falls behind rather than catch up with more than this.
constexpr double kMostBehind_s = 0.25;
/// Pairs that may wait for a thread.
constexpr std::size_t kMostWaiting = 1;
/// Stamp at which a stepped simulation begins; always the same, so that stamps repeat.
const ros::Time kSteppedStart(1000, 0);

/// A handle whose callbacks go to a queue of its own.
ros::NodeHandle onQueue(const ros::NodeHandle& handle, ros::CallbackQueue& queue) {
  ros::NodeHandle result(handle);
  result.setCallbackQueue(&queue);
  return result;
}

}  // namespace

/// Publishes at once; keeps pairs for the node to render.
class DrivenSimulatorNode::Sink : public ros_io::DrivenOutput<TopicOutlet> {
 public:
  explicit Sink(DrivenSimulatorNode& node) : DrivenOutput(*node.messages_, node.outlet_), node_(node) {}

  void takeContacts(double time_s, const std::vector<std::string>& names) override {
    DrivenOutput::takeContacts(time_s, names);
    node_.contacts_ = names;
    for (const std::string& name : names) ROS_WARN("the simulated robot touches: %s", name.c_str());
  }
  void takeShot(sim::StereoShot shot) override { node_.addShot(std::move(shot)); }
  void publish(const ros_io::PairMessages& pair) { writePair(pair); }

 private:
  DrivenSimulatorNode& node_;
};

DrivenSimulatorNode::DrivenSimulatorNode(const ros::NodeHandle& handle, DrivenSetup setup,
                                         const SimulatorParams& params)
    : handle_(onQueue(handle, queue_)),
      setup_(std::move(setup)),
      params_(params),
      outlet_(handle_),
      velocity_(handle_.subscribe(topics::kCmdVel, 10, &DrivenSimulatorNode::handleVelocity, this,
                                  ros::TransportHints().tcpNoDelay())),
      frame_answers_(handle_, queue_, params.frame_answers, params.answer_limit_s),
      step_answers_(handle_, queue_, params.step_answers, params.answer_limit_s),
      updater_(handle_, ros::NodeHandle("~")) {
  if (params_.stepped && !ros::Time::isSimTime()) {
    throw ParameterError(
        "~stepped is true and /use_sim_time is not: the other nodes would not follow the simulator's clock; set "
        "/use_sim_time before any node starts, as robot.launch stepped:=true does");
  }
  restart(params_.stepped ? kSteppedStart : ros::Time::now() + ros::Duration(params_.start_delay_s));
  advertise();
  if (params_.publish_tf_static) {
    tf_static_ = handle_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
    tf_static_.publish(messages_->staticTransforms());
  }
  services_ = {handle_.advertiseService("simulator/reset", &DrivenSimulatorNode::handleReset, this),
               handle_.advertiseService("simulator/pause", &DrivenSimulatorNode::handlePause, this)};
  updater_.setHardwareID("none");
  updater_.add("simulated robot", this, &DrivenSimulatorNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(1.0),
                                   [this](const ros::WallTimerEvent&) { updater_.update(); });
}

void DrivenSimulatorNode::advertise() {
  outlet_.advertise<WheelTicks>(topics::kWheelTicks);
  outlet_.advertise<sensor_msgs::JointState>(topics::kJointStates);
  outlet_.advertise<nav_msgs::Odometry>(topics::kGroundTruth);
  outlet_.advertise<Contacts>(ros_io::kContactsTopic, true);
  outlet_.advertise<sensor_msgs::Imu>(topics::kImu);
  outlet_.advertise<geometry_msgs::Quaternion>(topics::kImuQuaternion);
  if (!setup_.devices.rig.lasers.empty()) outlet_.advertise<sensor_msgs::LaserScan>(topics::kScan);
  for (std::size_t i = 0; i < setup_.devices.rig.ranges.size(); ++i)
    outlet_.advertise<sensor_msgs::Range>(messages_->rangeTopic(i));
  outlet_.advertise<StereoSync>(topics::kSync);
  outlet_.advertise<sensor_msgs::CameraInfo>(topics::kLeftInfo);
  outlet_.advertise<sensor_msgs::CameraInfo>(topics::kRightInfo);
  outlet_.advertiseImage(topics::kLeftImage);
  outlet_.advertiseImage(topics::kRightImage);
}

void DrivenSimulatorNode::restart(const ros::Time& start) {
  waiting_.clear();
  simulation_ = std::make_unique<sim::DrivenSimulation>(
      setup_.scenario, setup_.devices.rig, setup_.calibration, static_cast<std::uint64_t>(params_.seed));
  setStart(start);
}

void DrivenSimulatorNode::setStart(const ros::Time& start) {
  start_ = start;
  messages_ =
      std::make_shared<ros_io::DrivenMessages>(*simulation_, setup_.devices, setup_.T_base_imu, start_);
}

void DrivenSimulatorNode::run() {
  if (params_.stepped) {
    runStepped();
  } else {
    runLive();
  }
}

void DrivenSimulatorNode::runLive() {
  while (ros::ok()) {
    queue_.callAvailable(ros::WallDuration(kPoll_s));
    keepUp();
    Sink sink(*this);
    if (!is_paused_) simulation_->advance((ros::Time::now() - start_).toSec(), sink);
    render();
    publishRendered();
  }
}

/// A pause, and a machine that is too slow for the world, set the start later: stamps stay those of now.
void DrivenSimulatorNode::keepUp() {
  const double behind_s = (ros::Time::now() - start_).toSec() - simulation_->time_s();
  if (is_paused_ && behind_s > 0.0) setStart(start_ + ros::Duration(behind_s));
  if (is_paused_ || behind_s < kMostBehind_s) return;
  ++fallen_behind_;
  setStart(start_ + ros::Duration(behind_s));
  ROS_WARN_THROTTLE(
      5.0,
      "the simulation has stood still for %.2f s (%lu times so far): this machine is too busy for its "
      "motion and its laser in real time; end other programs, or drive stepped",
      behind_s, static_cast<unsigned long>(fallen_behind_));
}

void DrivenSimulatorNode::addShot(sim::StereoShot shot) {
  if (waiting_.size() < kMostWaiting || params_.stepped) {
    waiting_.push_back(std::move(shot));
    return;
  }
  ++dropped_;
  ROS_WARN_THROTTLE(5.0,
                    "%lu of %lu pairs were dropped: this machine does not render them in real time. Lower "
                    "rig/samples_per_pixel or rig/image_scale, or raise ~threads.",
                    static_cast<unsigned long>(dropped_), static_cast<unsigned long>(dropped_ + published_));
}

void DrivenSimulatorNode::render() {
  while (!waiting_.empty() && rendering_.size() < static_cast<std::size_t>(params_.threads)) {
    auto shot = std::make_shared<sim::StereoShot>(std::move(waiting_.front()));
    waiting_.pop_front();
    rendering_.push_back(
        std::async(std::launch::async, [messages = messages_, shot] { return messages->pair(*shot); }));
  }
}

/// In the order in which they were taken. Stepped, it waits for them.
void DrivenSimulatorNode::publishRendered() {
  const auto is_ready = [this] {
    return params_.stepped ||
           rendering_.front().wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  while (!rendering_.empty() && is_ready()) {
    Sink(*this).publish(rendering_.front().get());
    rendering_.pop_front();
    ++published_;
    if (params_.stepped) render();
  }
}

void DrivenSimulatorNode::runStepped() {
  clock_ = handle_.advertise<rosgraph_msgs::Clock>("/clock", 10, true);  // who comes late learns the time
  publishClock();
  frame_answers_.awaitPublishers(params_.answer_limit_s);
  step_answers_.awaitPublishers(params_.answer_limit_s);
  const ros::WallTime begin = ros::WallTime::now() + ros::WallDuration(params_.start_delay_s);
  while (ros::ok() && ros::WallTime::now() < begin) {
    queue_.callAvailable(ros::WallDuration(0.05));
  }
  while (ros::ok()) {
    queue_.callAvailable(ros::WallDuration(is_paused_ ? 0.05 : 0.0));
    if (!is_paused_) step();
  }
}

void DrivenSimulatorNode::step() {
  const std::uint64_t published = published_;
  Sink sink(*this);
  simulation_->advance(simulation_->time_s() + params_.step_s, sink);
  render();
  publishRendered();
  frame_answers_.expect(published_ - published);
  frame_answers_.await();
  step_answers_.expect(1);
  publishClock();
  step_answers_.await();
}

void DrivenSimulatorNode::publishClock() {
  rosgraph_msgs::Clock clock;
  clock.clock = messages_->stamp(simulation_->time_s());
  clock_.publish(clock);
}

void DrivenSimulatorNode::handleVelocity(const geometry_msgs::Twist::ConstPtr& message) {
  const kinematics::Twist twist(message->linear.x, message->linear.y, message->angular.z);
  if (twist.allFinite()) {
    simulation_->command(twist);
  } else {
    ROS_ERROR_THROTTLE(5.0,
                       "cmd_vel is refused: it holds values that are no numbers; its sender is at fault");
  }
}

bool DrivenSimulatorNode::handleReset(std_srvs::Trigger::Request& /*request*/,
                                      std_srvs::Trigger::Response& response) {
  restart(params_.stepped ? messages_->stamp(simulation_->time_s()) : ros::Time::now());
  contacts_.clear();
  outlet_.write(ros_io::kContactsTopic, start_, messages_->contacts(0.0, {}));
  response.success = 1;
  response.message = "robot and world are as at the start, counters at 0; odometries do not know it";
  return true;
}

bool DrivenSimulatorNode::handlePause(std_srvs::SetBool::Request& request,
                                      std_srvs::SetBool::Response& response) {
  keepUp();
  is_paused_ = request.data != 0;
  response.success = 1;
  response.message = fmt::format("{} at {:.3f} s", is_paused_ ? "stands" : "runs", simulation_->time_s());
  return true;
}

void DrivenSimulatorNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  status.summary(Level::OK, is_paused_ ? "paused" : "driven by cmd_vel");
  if (std::exchange(dropped_reported_, dropped_) != dropped_)
    status.summary(Level::WARN, "pairs are dropped: this machine does not render them in real time");
  if (!contacts_.empty()) status.mergeSummary(Level::WARN, "the robot touches " + contacts_.front());
  status.add("scenario", params_.scenario);
  status.add("simulated time [s]", simulation_->time_s());
  status.add("pairs published", published_);
  status.add("pairs dropped", dropped_);
  status.add("times that it fell behind", fallen_behind_);
  status.add("answers missed", frame_answers_.missed() + step_answers_.missed());
}

}  // namespace stereo_nav::nodes
