// The teleop node: the keyboard of its terminal drives the base, on cmd_vel_manual.
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <unistd.h>

#include <iostream>

#include "nodes/teleop/key_driver.h"
#include "nodes/teleop/terminal_keys.h"
#include "ros/node_program.h"
#include "ros/parameter_server.h"
#include "sensors/serial/steady_clock.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

using serial::steadyNow_s;

geometry_msgs::Twist toMessage(const kinematics::Twist& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.x();
  message.linear.y = twist.y();
  message.angular.z = twist.z();
  return message;
}

int run() {
  ros::NodeHandle handle, private_handle("~");
  TeleopParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle)}, params);
  KeyDriver driver(params);
  TerminalKeys keys(STDIN_FILENO);
  const auto publisher = handle.advertise<geometry_msgs::Twist>(ros_io::topics::kCmdVelManual, 1);
  const auto odom =
      handle.subscribe<nav_msgs::Odometry>("odom", 1, [&](const nav_msgs::Odometry::ConstPtr& m) {
        driver.setHeading(tf2::getYaw(m->pose.pose.orientation), steadyNow_s());
      });
  std::cout << keyHelp() << driver.speeds() << std::endl;
  double next_s = steadyNow_s();
  while (ros::ok() && !keys.closed()) {
    bool pressed = false;
    for (const char key : keys.read(std::max(0.0, next_s - steadyNow_s()))) {
      const auto text = driver.press(key, steadyNow_s());
      if (text) std::cout << *text << std::endl;
      pressed = true;
    }
    ros::spinOnce();
    if (!pressed && steadyNow_s() < next_s) continue;
    next_s = steadyNow_s() + 1.0 / params.rate_hz;
    const auto velocity = driver.velocity(steadyNow_s());
    if (!velocity) continue;
    publisher.publish(toMessage(*velocity));
    if (driver.lacksHeading(steadyNow_s()))
      ROS_WARN_THROTTLE(2.0,
                        "%s is silent, so that nobody knows the heading for field-centric driving: start the "
                        "odometry, or press f",
                        odom.getTopic().c_str());
  }
  publisher.publish(geometry_msgs::Twist());
  return 0;
}

}  // namespace
}  // namespace stereo_nav::nodes

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "teleop", stereo_nav::nodes::run);
}
