#include "nodes/cmd_vel_mux/cmd_vel_mux_node.h"

#include "ros/parameter_server.h"
#include "sensors/serial/steady_clock.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

using serial::steadyNow_s;

constexpr double kWatch_s = 0.02;

std::vector<VelocitySource> readSources(const ros::NodeHandle& private_handle) {
  CmdVelMuxParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle, {"diagnostic_period"})}, params);
  return {{ros_io::topics::kCmdVelStop, params.stop_timeout_s, true},
          {ros_io::topics::kCmdVelManual, params.manual_timeout_s},
          {ros_io::topics::kCmdVelAuto, params.auto_timeout_s}};
}

}  // namespace

void CmdVelMuxParams::describe(ParameterVisitor& visitor) {
  const Range<double> range{0.02, 10.0};
  visitor.real("stop_timeout_s", stop_timeout_s, range, "s",
               "for how long a message on cmd_vel_stop keeps all others out");
  visitor.real("manual_timeout_s", manual_timeout_s, range, "s",
               "for how long a message on cmd_vel_manual keeps cmd_vel_auto out");
  visitor.real("auto_timeout_s", auto_timeout_s, range, "s",
               "after a message on cmd_vel_auto a zero velocity follows when none comes for this long");
}

CmdVelMuxNode::CmdVelMuxNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : mux_(readSources(private_handle)), updater_(handle, private_handle) {
  publisher_ = handle.advertise<geometry_msgs::Twist>(ros_io::topics::kCmdVel, 1);
  for (std::size_t i = 0; i < mux_.sources().size(); ++i) {
    subscribers_.push_back(handle.subscribe<geometry_msgs::Twist>(
        mux_.sources()[i].topic, 1,
        [this, i](const geometry_msgs::Twist::ConstPtr& message) { this->handle(i, *message); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }
  updater_.setHardwareID("none");
  updater_.add("cmd_vel", this, &CmdVelMuxNode::fillStatus);
  timer_ = handle.createWallTimer(ros::WallDuration(kWatch_s), &CmdVelMuxNode::watch, this);
}

void CmdVelMuxNode::handle(std::size_t source, const geometry_msgs::Twist& message) {
  if (!mux_.offer(source, steadyNow_s())) return;
  if (active_ != source) ROS_INFO_STREAM("cmd_vel follows " << mux_.sources()[source].topic);
  active_ = source;
  publisher_.publish(mux_.sources()[source].stops ? geometry_msgs::Twist() : message);
}

void CmdVelMuxNode::watch(const ros::WallTimerEvent& /*event*/) {
  updater_.update();
  if (const double pause_s = mux_.tick(steadyNow_s()); pause_s > 0.0) {
    ROS_WARN(
        "cmd_vel_mux stood still for %.1f s: cmd_vel is zero, and what waited meanwhile is dropped; this computer "
        "is overloaded or was suspended, or the program was stopped by a signal",
        pause_s);
  }
  if (!active_ || mux_.active(steadyNow_s()) == active_) return;
  ROS_INFO_STREAM(mux_.sources()[*active_].topic
                  << " has fallen silent: cmd_vel is zero until another one begins");
  active_.reset();
  publisher_.publish(geometry_msgs::Twist());
}

void CmdVelMuxNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto now_active = mux_.active(steadyNow_s());
  status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                 now_active ? "cmd_vel follows " + mux_.sources()[*now_active].topic : "all are silent");
  for (std::size_t i = 0; i < mux_.sources().size(); ++i) {
    status.add(mux_.sources()[i].topic + " passed", mux_.passed(i));
    status.add(mux_.sources()[i].topic + " kept out", mux_.dropped(i));
  }
}

}  // namespace stereo_nav::nodes
